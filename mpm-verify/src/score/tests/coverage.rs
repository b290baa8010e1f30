//! Series that end early, are coarse, of other units or out of order.

use super::*;

/// A result of a case with a series of these columns.
fn with_series(case: &str, level: &str, columns: &[(&str, Vec<f64>)]) -> Answer {
    let result = Answer::exported(case, level, &[]);
    Table::of_columns(columns.iter().cloned()).write(&result.path("series.csv")).unwrap();
    result.say("particles", Value::Null);
    result
}

/// A change of rows.
type Change = fn(&mut Vec<(f64, f64)>);

/// The inviscid front, told as that of a code, after `change` of its rows.
fn front(change: Change) -> Result<Scores, Error> {
    let curve = Answer::exported("dam-break", "h0.5", &[]);
    let mut rows = Table::read(&curve.path("reference-front.csv")).unwrap().points("time", "front");
    change(&mut rows);
    let (time, front) = rows.into_iter().unzip();
    with_series("dam-break", "h0.5", &[("time (s)", time), ("front (m)", front)]).scores()
}

/// Outcome and source of the checks of a name.
fn found(scored: &Scored, check: &str) -> Vec<(Outcome, String)> {
    let own = scored.record.verdicts.iter().filter(|v| v.check == check && !v.is_wanted());
    own.map(|v| (v.outcome, v.source.clone())).collect()
}

#[test]
fn a_series_that_does_not_show_what_is_judged_is_not_judged() {
    let sound = front(|_| ()).unwrap();
    for check in ["front", "arrival"] {
        assert_eq!(found(&sound.runs[0], check)[0].0, Outcome::Right, "{:?}", found(&sound.runs[0], check));
    }
    assert!(gate::gate(false, &["front"]).refusal(&sound).is_none());
    // The pressure behind the gate is wanted too.
    let strict = gate::gate(true, &["front"]).refusal(&sound).unwrap_or_default();
    assert!(strict.contains("pressure (pressure-profile: missing: "), "{strict}");
    let changes: [(Change, &str); 5] = [
        (|rows| rows.iter_mut().for_each(|row| row.0 *= 1000.0), "begins at time"),
        (|rows| rows.iter_mut().for_each(|row| row.0 += 1.0), "begins at time"),
        (|rows| rows.iter_mut().for_each(|row| row.0 /= 60.0), "ends at time"),
        (|rows| rows.retain(|row| row.0 < 0.3), "ends at time"),
        (|rows| *rows = vec![rows[0], rows[rows.len() / 2], rows[rows.len() - 1]], "apart after time"),
    ];
    for (change, named) in changes {
        let scored = front(change).unwrap();
        for check in ["front", "arrival"] {
            let (outcome, source) = found(&scored.runs[0], check).remove(0);
            assert!(outcome == Outcome::NotJudged && source.contains(named), "{check} {outcome:?}: {source}");
        }
        assert!(scored.runs[0].record.metrics["arrival_error"].value.is_none());
        assert!(gate::gate(false, &[]).refusal(&scored).is_some());
    }
}

#[test]
fn rows_out_of_order_are_refused_with_their_line() {
    let changes: [Change; 2] = [|rows| rows.swap(3, 4), |rows| rows[4].0 = rows[3].0];
    for change in changes {
        let said = front(change).map(|_| ()).unwrap_err().to_string();
        assert!(said.contains("series.csv: line 6: time (s) 0.") && said.contains("rows in rising order"), "{said}");
    }
}

#[test]
fn a_column_is_judged_between_rows_at_the_times_of_the_reference_alone() {
    let lines = |keep: fn(usize) -> bool| {
        let result = Answer::of_column();
        let text = result.text("series.csv");
        let kept = text.lines().enumerate().filter(|(k, _)| *k == 0 || keep(*k));
        let kept: Vec<&str> = kept.map(|(_, line)| line).collect();
        fs::write(result.path("series.csv"), kept.join("\n") + "\n").unwrap();
        result.score().unwrap()
    };
    let early = lines(|k| k < 3);
    assert_eq!(early.record.metrics["settlement_error"].value, None);
    for (scored, named) in [
        (early, "ends at time_factor = "),
        (lines(|k| k > 2), "begins at time_factor = "),
        (lines(|k| [1, 8].contains(&k)), "2 rows are too few"),
    ] {
        for check in ["settlement", "base-pressure"] {
            let (outcome, source) = found(&scored, check).remove(0);
            assert!(outcome == Outcome::NotJudged && source.contains(named), "{check} {outcome:?}: {source}");
        }
    }
}

/// Load of a quasi-static run of ours, in steps of the penetration of 0.25·10⁻³.
const LOADS: [f64; 16] = [
    129.8246, 209.1566, 237.2537, 254.9653, 266.9892, 275.3610, 281.1136, 284.1942, 284.2168, 283.0682, 282.8440,
    283.0420, 283.3268, 283.6200, 283.9842, 284.2151,
];

#[test]
fn a_footing_is_read_between_rows_where_its_curvature_allows() {
    let pressed = |rows: &[(f64, f64)], scale: f64| {
        let (penetration, force): (Vec<f64>, Vec<f64>) = rows.iter().map(|(s, f)| (1e-3 * scale * s, *f)).unzip();
        let result = with_series("footing", "b10", &[("penetration (-)", penetration), ("footing_force (N/m)", force)]);
        result.say("basis", json!("gimp"));
        result.score().unwrap()
    };
    let outcomes = |scored: &Scored, check| found(scored, check).into_iter().map(|(o, _)| o).collect::<Vec<_>>();
    let rows: Vec<(f64, f64)> = (1..).zip(LOADS).map(|(k, load)| (0.25 * f64::from(k), load)).collect();
    let sound = pressed(&rows, 1.0);
    assert_eq!(outcomes(&sound, "curve"), [Outcome::Right; 6], "{:?}", found(&sound, "curve"));
    assert_eq!(outcomes(&sound, "prandtl"), [Outcome::Right]);
    let between = sound.record.value("nc_0.0003");
    assert!((between - 2.99).abs() < 0.02, "{between}");
    // Every other row leaves the beginning of the curve open, and the plateau known.
    let coarse: Vec<(f64, f64)> = rows.iter().copied().skip(1).step_by(2).collect();
    let open = found(&pressed(&coarse, 1.0), "curve").remove(0);
    assert!(open.0 == Outcome::NotJudged && open.1.contains("closer rows show it"), "{open:?}");
    // Penetration in per cent, and a series that ends at three quarters.
    for (rows, scale, named) in [(&rows[..], 100.0, "begins at"), (&rows[..12], 1.0, "ends at")] {
        let scored = pressed(rows, scale);
        for check in ["prandtl", "limit-load", "fem-plateau"] {
            let (outcome, source) = found(&scored, check).remove(0);
            assert!(outcome == Outcome::NotJudged && source.contains(named), "{check} {outcome:?}: {source}");
        }
    }
}

#[test]
fn an_energy_that_is_bounded_is_judged_of_rows_that_show_it() {
    let energies = |rows: &[f64]| {
        let zeros = || vec![0.0; rows.len()];
        let columns = [
            ("kinetic_energy (J/m)", zeros()),
            ("stress_work (J/m)", rows.to_vec()),
            ("load_work (J/m)", rows.to_vec()),
            ("damping_losses (J/m)", zeros()),
        ];
        found(&with_series("cook", "h2", &columns).score().unwrap(), "no-energy-gain").remove(0).0
    };
    assert_eq!(energies(&[0.01, 0.025, 0.04, 0.055, 0.07]), Outcome::Right);
    assert_eq!(energies(&[0.08]), Outcome::NotJudged);
    assert_eq!(energies(&[0.01, 0.08]), Outcome::NotJudged);
    assert_eq!(energies(&[-0.02, -0.04, -0.06, -0.08]), Outcome::Failed);
}

/// A pressure that alternates from particle to particle is not that of the reference, whatever its mean.
#[test]
fn a_footing_with_a_checkerboard_is_not_smooth() {
    let result = Answer::exported("footing", "b10", &[]);
    let start = Table::read(&result.path("start.csv")).unwrap();
    let [x, y] = ["reference_x", "reference_y"].map(|name| start.column(name).to_vec());
    let smooth = |amplitude: f64| {
        let value = |k: usize| {
            let board = [(x[k] / 0.05).floor(), (y[k] / 0.05).floor()].iter().sum::<f64>().rem_euclid(2.0);
            -200.0 + amplitude * (2.0 * board - 1.0)
        };
        let stress = (0..x.len()).map(value).collect();
        let heads = ["reference_x (m)", "reference_y (m)", "mean_stress (Pa)"];
        let columns = heads.into_iter().zip([x.clone(), y.clone(), stress]);
        Table::of_columns(columns).write(&result.path("particles.csv")).unwrap();
        result.say("series", Value::Null);
        found(&result.score().unwrap(), "smooth-squares").remove(0).0
    };
    assert_eq!([0.0, 50.0, 200.0, 1e6].map(smooth), [Outcome::Right, Outcome::Right, Outcome::Failed, Outcome::Failed]);
}

/// Zeros of a wave are those of rows that show every period, and a bound by the time step needs one.
#[test]
fn a_wave_is_judged_of_rows_that_show_its_periods() {
    let told = |rows: usize, speed: f64, more: &[(&str, Value)]| {
        let omega = speed * std::f64::consts::PI * (1e7 * 0.7 / (1.3 * 0.4) / 1000.0_f64).sqrt();
        let time: Vec<f64> = (1..=rows).map(|k| 1.73 * k as f64 / rows as f64).collect();
        let mode = time.iter().map(|t| (omega * t).sin()).collect();
        let kinetic: Vec<f64> = time.iter().map(|t| (omega * t).cos().powi(2)).collect();
        let start = kinetic_energy(&Answer::exported("vibrating-bar", "n8", &[]));
        let columns = [
            ("time (s)", time.clone()),
            ("mode (-)", mode),
            ("kinetic_energy (J)", kinetic.iter().map(|k| k * start).collect()),
            ("energy (J)", vec![start; rows]),
        ];
        let result = with_series("vibrating-bar", "n8", &columns);
        more.iter().for_each(|(key, value)| result.say(key, value.clone()));
        result.score().unwrap()
    };
    let step = [("time_step_s", json!(1e-5))];
    let outcome = |scored: &Scored, check| found(scored, check).remove(0);
    let sound = told(4000, 1.0, &step);
    for check in ["frequency", "keeps-energy", "no-energy-gain"] {
        assert_eq!(outcome(&sound, check).0, Outcome::Right, "{:?}", outcome(&sound, check));
    }
    let ratio = sound.record.value("frequency_ratio");
    assert!((ratio - 1.0).abs() < 1e-4, "{ratio}");
    assert_eq!(outcome(&told(4000, 1.1, &step), "frequency").0, Outcome::Failed);
    let coarse = outcome(&told(500, 1.0, &step), "frequency");
    assert!(coarse.0 == Outcome::NotJudged && coarse.1.contains("begins at time"), "{coarse:?}");
    let silent = outcome(&told(4000, 1.0, &[]), "no-energy-gain");
    assert!(silent.0 == Outcome::NotJudged && silent.1.contains("`time_step_s`"), "{silent:?}");
}

/// Kinetic energy (J) of the bar at its start, ¼ ρ ω² A² L.
fn kinetic_energy(of: &Answer) -> f64 {
    let parameters = of.json("problem.json")["parameters"].clone();
    let value = |name: &str| {
        let own = parameters.as_array().unwrap().iter().find(|p| p["name"] == name);
        own.unwrap()["value"].as_f64().unwrap()
    };
    let nu = value("poisson_ratio");
    let modulus = value("young_modulus") * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
    0.25 * modulus * (std::f64::consts::PI * value("amplitude")).powi(2)
}

/// Factors that leave a wide bracket, or none, say nothing of the factor of safety.
#[test]
fn a_factor_of_safety_is_that_of_a_narrow_bracket() {
    let trials = |rows: &[(f64, f64)]| {
        let (factors, fails) = rows.iter().copied().unzip();
        let scored = with_series("slope-stability", "h0.4", &[("factor (-)", factors), ("fails (-)", fails)]).score();
        found(&scored.unwrap(), "limit-load").remove(0)
    };
    for (rows, expected) in [
        (&[(1.65, 0.0), (1.66, 1.0), (2.0, 1.0)][..], Outcome::Right),
        (&[(2.0, 0.0), (2.01, 1.0)], Outcome::Failed),
        (&[(3.0, 0.0)], Outcome::Failed),
        (&[(1.0, 0.0), (2.3, 1.0)], Outcome::NotJudged),
        (&[(1.5, 0.0)], Outcome::NotJudged),
        (&[(1.7, 0.0), (1.65, 1.0)], Outcome::NotJudged),
    ] {
        let (outcome, source) = trials(rows);
        assert_eq!(outcome, expected, "{rows:?}: {source}");
    }
}

#[test]
fn a_column_that_ends_early_or_begins_late_is_judged_of_what_it_shows() {
    let outcomes = |times: &[f64]| {
        let series = [
            ("time_factor (-)", times.to_vec()),
            ("settlement (-)", times.iter().map(|t| crate::exact::terzaghi::settlement(*t)).collect()),
            ("overshoot (-)", vec![-1e-3; times.len()]),
        ];
        let scored = with_series("terzaghi", "n10", &series).score().unwrap();
        ["near-terzaghi", "bounded-overshoot"].map(|check| found(&scored, check).remove(0).0)
    };
    let [right, open] = [Outcome::Right, Outcome::NotJudged];
    assert_eq!(outcomes(&[0.0025, 0.05, 0.1]), [right, right]);
    assert_eq!(outcomes(&[0.0025, 0.05]), [open, right]);
    assert_eq!(outcomes(&[0.005, 0.1]), [right, open]);
}

/// A ground that is looked at only while it slides has no state of rest, and a slide that ends early no end.
#[test]
fn a_slide_is_judged_of_rows_at_its_start_and_its_end() {
    let outcomes = |times: &[f64]| {
        let zeros = || vec![0.0; times.len()];
        let series = [("time (s)", times.to_vec()), ("failed_share (-)", zeros()), ("base_force (N/m)", zeros())];
        let result = with_series("landslide-2d", "h0.4", &series);
        result.say("parameters", json!({"reduction": 1}));
        let scored = result.score().unwrap();
        ["base-reaction", "stands"].map(|check| found(&scored, check).remove(0).0)
    };
    let [right, open, failed] = [Outcome::Right, Outcome::NotJudged, Outcome::Failed];
    assert_eq!(outcomes(&[-0.5, 0.0, 2.0, 5.5]), [failed, right]);
    assert_eq!(outcomes(&[0.1, 5.5]), [open, right]);
    assert_eq!(outcomes(&[0.0, 2.0]), [failed, open]);
}
