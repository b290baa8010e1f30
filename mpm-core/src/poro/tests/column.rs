//! Columns that are too short for their grains, and that start deformed.

use super::*;

/// A column half as high has less room than its grains take: 1 − (1 − n)/J of pores.
#[test]
fn pores_that_close_are_a_typed_error() {
    let solver = loaded::<1, Hats<1>>(0.0, Settings::new(1.0));
    let setting = solver.setting(1.0, Vec::new()).unwrap();
    let mut values = vec![0.0; setting.unknowns.count];
    // From the node after the one that is held.
    let places = setting.unknowns.displacement.iter().flatten();
    let free = places.filter_map(|place| match place {
        Place::Free(i) => Some(*i),
        _ => None,
    });
    for (above, i) in free.enumerate() {
        values[i] = -0.5 * H * (above + 1) as f64;
    }
    let failed = solver.equations(&setting, 1.0).trial(&values).err();
    match failed {
        Some((_, Fault::NonPositivePorosity(share))) => {
            let exact = 1.0 - (1.0 - POROSITY) / 0.5;
            assert!((share - exact).abs() < 1e-12, "{share}");
        }
        other => panic!("{other:?}"),
    }
}

/// A body that starts deformed has the domains, and so the equations, of one that a step has deformed so.
#[test]
fn a_start_that_is_deformed_has_deformed_domains() {
    type Deformed = fn(&[f64; 2]) -> ([f64; 2], SMatrix<f64, 2, 2>);
    fn begun<I: OfHats<2>>(f: Deformed) -> Result<Solver<2>, Error> {
        Solver::new::<I>(standing(porous(), f), water(), Settings::new(1.0))
    }
    let squeezed: Deformed = |x| ([x[0], 0.8 * x[1]], SMatrix::from([[1.0, 0.0], [0.0, 0.8]]));
    let solver = begun::<Means<2>>(squeezed).unwrap();
    let half_size = solver.pores.half_size.iter();
    for (l, volume) in half_size.zip(&solver.particles().volume) {
        assert!((l[0] - 0.25 * H).abs() < 1e-12 && (l[1] - 0.2 * H).abs() < 1e-12);
        assert!((4.0 * l[0] * l[1] - volume).abs() < 1e-11 * volume);
    }
    // Sheared: extents along the axes are those of the affine image, brought to its volume.
    let solver = begun::<Means<2>>(|x| (*x, SMatrix::from([[1.0, 0.3], [0.0, 1.1]]))).unwrap();
    // Those on the floor end there.
    let half_size = solver.pores.half_size.iter();
    for (l, x) in half_size.zip(&solver.particles().position) {
        let high = (0.275 * H).min(x[1]);
        assert!((l[0] - 0.25 * H).abs() < 1e-12 && (l[1] - high).abs() < 1e-12);
    }
    // Too long for means over a cell at most, and by so much; hats know no domain.
    let stretched: Deformed = |x| ([x[0], 0.5 * x[1]], SMatrix::from([[1.0, 0.0], [0.0, 2.2]]));
    match begun::<Means<2>>(stretched).err() {
        Some(Error::Breakdown { step: 0, fault: Fault::WideDomain(cells), .. }) => {
            assert!((cells - 0.55).abs() < 1e-12)
        }
        other => panic!("{other:?}"),
    }
    assert!(begun::<Hats<2>>(stretched).is_ok());
}
