//! Every remedy against every criterion, over all cases.

use crate::record::{Record, Status};
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::study::summary::Summary;
use std::fmt::Write;

const BASES: [BasisName; 2] = [BasisName::Gimp, BasisName::Bspline2];
const REMEDIES: [RemedyName; 5] = [
    RemedyName::None,
    RemedyName::FbarRecursive,
    RemedyName::FbarTotal,
    RemedyName::FbarRate,
    RemedyName::FbarConsistent,
];

/// A criterion: what it is and how a scheme does.
type Criterion = (
    &'static str,
    fn(&Summary, BasisName, RemedyName) -> Option<String>,
);

const CRITERIA: [Criterion; 13] = [
    (
        "column, 5·10⁵ steps: drift of J̄ per 10⁵ steps",
        |s, b, r| {
            Some(short(
                of(s, "column", b, r, "h0.25", &["duration=5.04"])?.value("j_drift_per_1e5_steps"),
            ))
        },
    ),
    ("… of J", |s, b, r| {
        Some(short(
            of(s, "column", b, r, "h0.25", &["duration=5.04"])?.value("true_j_drift_per_1e5_steps"),
        ))
    }),
    (
        "… kinetic energy, last third over middle third",
        |s, b, r| {
            Some(short(
                of(s, "column", b, r, "h0.25", &["duration=5.04"])?.value("kinetic_growth"),
            ))
        },
    ),
    ("order, mms-axis, Δt ∝ h", |s, b, r| {
        order(s, "mms-axis", b, r, &[])
    }),
    ("order, mms-axis, Δt ∝ h²", |s, b, r| {
        order(s, "mms-axis", b, r, &["step_scaling=h2"])
    }),
    ("order, mms-wall-pressure, Δt ∝ h", |s, b, r| {
        order(s, "mms-wall-pressure", b, r, &[])
    }),
    ("order, mms-wall-pressure, Δt ∝ h²", |s, b, r| {
        order(s, "mms-wall-pressure", b, r, &["step_scaling=h2"])
    }),
    ("price: error over that of none, mms-axis n32", |s, b, r| {
        ratio(s, "mms-axis", b, (r, &[]), (RemedyName::None, &[]))
    }),
    (
        "… with cells crossed (A = 0.02 m, 2 particles per direction)",
        |s, b, r| {
            let set = &["amplitude=0.02"];
            ratio(s, "mms-axis", b, (r, set), (RemedyName::None, set))
        },
    ),
    (
        "locking: error at ν = 0.4999 over 0.3, mms-vortex-box n32",
        |s, b, r| {
            ratio(
                s,
                "mms-vortex-box",
                b,
                (r, &[]),
                (r, &["poisson_ratio=0.3"]),
            )
        },
    ),
    ("spurious pressure there (Pa)", |s, b, r| {
        Some(short(
            of(s, "mms-vortex-box", b, r, "n32", &[])?.value("mean_stress_l2"),
        ))
    }),
    ("Cook, h = 1 m: mid-edge error (%)", |s, b, r| {
        let run = of(s, "cook", b, r, "h1", &[])?;
        let error = 100.0 * run.value("fem_mid_edge_error");
        let rest = if run.value("at_rest") == 1.0 {
            ""
        } else {
            ", never at rest"
        };
        Some(format!("{error:.2}{rest}"))
    }),
    ("standing wave, 20 periods, n8", |s, b, r| {
        let run = of(s, "standing-wave", b, r, "n8", &["duration=24"])?;
        Some(match &run.error {
            Some(e) => format!("breaks down at {:.1} s", e.time),
            None if run.value("log_jacobian_gap") > DISORDER => "in disorder".to_owned(),
            None => format!("frequency × {:.2}", run.value("frequency_ratio")),
        })
    }),
];

/// rms ln(J/J̄) beyond which particles have lost their order.
const DISORDER: f64 = 0.1;

fn short(x: f64) -> String {
    match x.abs() {
        _ if x.is_nan() => "–".to_owned(),
        size if size != 0.0 && !(0.01..1e3).contains(&size) => format!("{x:.1e}"),
        _ => format!("{x:.2}"),
    }
}

fn of<'a>(
    summary: &'a Summary,
    case: &str,
    basis: BasisName,
    remedy: RemedyName,
    level: &str,
    set: &[&str],
) -> Option<&'a Record> {
    let study = summary.cases.iter().find(|c| c.case == case)?;
    let scheme = Scheme::flip(basis, remedy);
    study
        .records
        .iter()
        .find(|r| r.scheme() == scheme && r.level == level && r.set == set)
}

fn order(
    summary: &Summary,
    case: &str,
    basis: BasisName,
    remedy: RemedyName,
    set: &[&str],
) -> Option<String> {
    let study = summary.cases.iter().find(|c| c.case == case)?;
    let scheme = Scheme::flip(basis, remedy);
    let entry = study
        .convergence
        .iter()
        .find(|c| c.scheme == scheme && c.set == set && c.metric == "displacement_l2")?;
    let order = entry.order.as_ref()?;
    Some(format!("{:.2} ± {:.2}", order.order, order.uncertainty))
}

/// The error of u of one remedy and set of parameters over that of another, at n32.
fn ratio(
    summary: &Summary,
    case: &str,
    basis: BasisName,
    (remedy, set): (RemedyName, &[&str]),
    (other, others): (RemedyName, &[&str]),
) -> Option<String> {
    let error = |remedy, set| {
        let run = of(summary, case, basis, remedy, "n32", set)?;
        (run.status == Status::Ok).then(|| run.value("displacement_l2"))
    };
    Some(short(error(remedy, set)? / error(other, others)?))
}

/// The table in Markdown; nothing if no criterion was measured.
pub(super) fn table(summary: &Summary) -> Option<String> {
    let mut text = String::new();
    for basis in BASES {
        let rows = CRITERIA.iter().filter_map(|(name, measure)| {
            let cells = REMEDIES.map(|remedy| measure(summary, basis, remedy));
            let any = cells.iter().any(Option::is_some);
            let cells = cells.map(|c| c.unwrap_or_else(|| "–".to_owned()));
            any.then(|| format!("| {name} | {} |", cells.join(" | ")))
        });
        let rows: Vec<String> = rows.collect();
        if !rows.is_empty() {
            let names = REMEDIES.map(|r| r.to_string()).join(" | ");
            let _ = writeln!(
                text,
                "\n### {basis}\n\n| | {names} |\n|{}\n{}",
                "---|".repeat(REMEDIES.len() + 1),
                rows.join("\n")
            );
        }
    }
    (!text.is_empty()).then_some(text)
}
