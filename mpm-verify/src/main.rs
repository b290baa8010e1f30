//! x
#![allow(clippy::all, clippy::unwrap_used, clippy::print_stdout)]
use mpm_verify::*;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let case = cases::find("cook").unwrap();
    let spec = case::RunSpec { scheme: scheme::Scheme::flip(scheme::BasisName::parse(&a[1]).unwrap(), scheme::RemedyName::parse(&a[2]).unwrap()), level: case::find_level(case, &a[3]).unwrap(), set: a[4..].to_vec() };
    let r = run::execute(case, &spec, Some(&std::path::Path::new("/tmp/out").join(spec.folder())), 1, &|_| ()).unwrap();
    println!("{} {:?}", spec.folder(), r.time);
    for (k, m) in &r.metrics { println!("  {k} = {:?} {}", m.value.unwrap_or(f64::NAN), m.unit); }
}
