//! Short runs and what they end with, a line each: a checksum of the bits of positions, velocities and stresses, then
//! kinetic and stored energy and the mean of J.
//!
//! `.ci/paths` compares them between builds for different instructions.

mod body;

use body::{DENSITY, fluid, sheared, soil, solid};
use mpm_core::basis::{CubicBSpline, Gimp, QuadraticBSpline};
use mpm_core::explicit::remedy::{Fbar, Form, Standard};
use mpm_core::explicit::transfer::{Apic, Flip, Xpic};
use mpm_core::explicit::{Remedy, Transfer};
use mpm_core::material::Law;
use mpm_core::{Basis, Particles, Simulation};
use std::error::Error;
use std::io::{Write, stdout};

const STEPS: usize = 50;
/// How far a wave goes while a body is squeezed by all of its size, in sizes.
const SLOWNESS: f64 = 15.0;

/// The instructions that this program is built for.
fn instructions() -> String {
    let built_for = [
        ("sse2", cfg!(target_feature = "sse2")),
        ("neon", cfg!(target_feature = "neon")),
        ("fma", cfg!(target_feature = "fma")),
        ("avx2", cfg!(target_feature = "avx2")),
        ("avx512f", cfg!(target_feature = "avx512f")),
    ];
    let names = built_for.iter().filter(|(_, has)| *has).map(|(name, _)| *name);
    names.collect::<Vec<_>>().join(" ")
}

/// FNV-1a of the bits, a word at a time.
fn checksum<const D: usize>(p: &Particles<D>) -> u64 {
    let stress = p.stress.iter().map(|s| [s.xx, s.yy, s.zz, s.xy, s.yz, s.xz]);
    let moved = p.position.iter().flatten().chain(p.velocity.iter().flatten());
    moved
        .copied()
        .chain(stress.flatten())
        .fold(0xcbf2_9ce4_8422_2325, |sum, value| (sum ^ value.to_bits()).wrapping_mul(0x0100_0000_01b3))
}

fn run<const D: usize, const S: usize, B: Basis<S>>(
    name: &str,
    law: impl Law + 'static,
    remedy: impl Remedy<D> + 'static,
    transfer: impl Transfer<D>,
) -> Result<(), Box<dyn Error>> {
    // Odd, so that some particles have no seven others beside them.
    let n = if D == 2 { 21 } else { 11 };
    let rate = law.wave_speed(DENSITY) / (SLOWNESS * 0.5 * n as f64);
    let mut solver = sheared::<D, S, B, _>(n, rate, law, remedy, transfer)?;
    for _ in 0..STEPS {
        solver.step()?;
    }
    if solver.work().sorts < 2 {
        return Err(format!("{name}: not sorted on the way").into());
    }
    let p = solver.particles();
    let totals = solver.totals();
    let mean_jacobian = p.jacobian.iter().sum::<f64>() / p.len() as f64;
    writeln!(
        stdout(),
        "{name} {:016x} {:.16e} {:.16e} {mean_jacobian:.16e}",
        checksum(p),
        totals.kinetic_energy,
        totals.stored_energy,
    )?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    writeln!(stdout(), "{}", instructions())?;
    let (solid, soil, fluid) = (solid()?, soil()?, fluid()?);
    let (flip, xpic) = (Flip::default(), || Xpic::new(3));
    let (total, rate) = (|| Fbar::new(Form::Total), || Fbar::new(Form::Rate));
    let (recursive, consistent) = (|| Fbar::new(Form::Recursive), || Fbar::new(Form::Consistent));

    run::<2, 3, Gimp>("2d-solid-gimp", solid, Standard, flip)?;
    run::<2, 3, QuadraticBSpline>("2d-solid-bspline2-total-apic", solid, total(), Apic)?;
    run::<2, 4, CubicBSpline>("2d-solid-bspline3-rate", solid, rate(), flip)?;
    run::<2, 3, Gimp>("2d-soil-gimp-consistent", soil, consistent(), flip)?;
    run::<2, 3, QuadraticBSpline>("2d-soil-bspline2-recursive", soil, recursive(), flip)?;
    run::<2, 4, CubicBSpline>("2d-soil-bspline3-apic", soil, Standard, Apic)?;
    run::<2, 3, Gimp>("2d-fluid-gimp-recursive-xpic3", fluid, recursive(), xpic()?)?;
    run::<2, 3, QuadraticBSpline>("2d-fluid-bspline2-consistent", fluid, consistent(), flip)?;

    run::<3, 3, Gimp>("3d-solid-gimp-rate-apic", solid, rate(), Apic)?;
    run::<3, 4, CubicBSpline>("3d-solid-bspline3", solid, Standard, flip)?;
    run::<3, 3, Gimp>("3d-soil-gimp", soil, Standard, flip)?;
    run::<3, 3, QuadraticBSpline>("3d-soil-bspline2-consistent-apic", soil, consistent(), Apic)?;
    run::<3, 3, QuadraticBSpline>("3d-soil-bspline2-recursive-xpic3", soil, recursive(), xpic()?)?;
    run::<3, 3, Gimp>("3d-fluid-gimp-total", fluid, total(), flip)
}
