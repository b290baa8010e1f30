//! Every law with every kind of solver, basis, remedy and transfer, in one, two and three dimensions.

use super::*;

pub(super) const LAWS: [(&str, &str); 8] = [
    ("neo-hookean", "young_modulus_pa = 1e6\npoisson_ratio = 0.3"),
    ("hencky", "young_modulus_pa = 1e6\npoisson_ratio = 0.3"),
    ("drucker-prager", "young_modulus_pa = 1e6\npoisson_ratio = 0.3\ncohesion_pa = 1e3\nfriction_deg = 30"),
    ("hencky-j2", "young_modulus_pa = 1e6\npoisson_ratio = 0.3\nstrength.undrained = { shear_strength_pa = 1e3 }"),
    ("newtonian-fluid", "bulk_modulus_pa = 1e6\nviscosity_pa_s = 10"),
    ("improved-hencky", "bulk_parameter = 1e6\nshear_modulus_pa = 4e5"),
    (
        "cam-clay",
        "bulk_parameter = 5e4\nshear_modulus_pa = 4e5\ncritical_ratio = 1\nplastic_compressibility = 0.1\npreconsolidation_pa = 2e4\ninitial_pressure_pa = 1e4",
    ),
    ("mohr-coulomb", "young_modulus_pa = 1e6\npoisson_ratio = 0.3\ncohesion_pa = 1e3\nfriction_deg = 30"),
];

/// A body of two cells along each axis that begins to sag between rollers.
pub(super) fn text(dimension: usize, (law, constants): (&str, &str), scheme: &str) -> String {
    let all = |entry: &str| vec![entry; dimension].join(", ");
    let up = ["x", "y", "z"][dimension - 1];
    let rollers = ["x", "y", "z"][..dimension].iter().map(|axis| {
        format!("[[supports]]\nwall = {{ name = \"{axis}\", axis = \"{axis}\", end = \"lo\", kind = \"roller\" }}\n")
    });
    let mut pull = vec!["0"; dimension];
    pull[dimension - 1] = "-0.1";
    let water = format!(
        "[water]\nporosity = 0.4\nconductivity.constant = {{ m2_pa_s = 1e-9 }}\ndrained = {{ {up}_m = [1.7, inf] }}\n"
    );
    let wet = scheme.starts_with("poro");
    let projection = if scheme.ends_with("ppp") { "projection_per_pa = 1e-6\n" } else { "" };
    format!(
        "format = 1\ntitle = \"Pair\"\n[grid]\ncell_size_m = 1\nlower_m = [{}]\ncells = [{}]\nends = [{}]\n[body]\n\
         density_kg_m3 = 1000\nparticles_per_direction = 2\n[[body.shapes]]\nbox = {{ from_m = [{}], to_m = [{}] }}\n\
         [law.{law}]\n{constants}\n{}{}[[loads]]\ngravity = {{ acceleration_m_s2 = [{}], rise_s = 1 }}\n[solver]\n\
         scheme = \"{scheme}\"\ntime_step_s = 1e-3\n{projection}[[phases]]\nname = \"sag\"\nduration_s = 2e-3\n\
         [output]\nrow_s = 2e-3\n",
        all("0"),
        all("8"),
        all("\"wall-open\""),
        all("0"),
        all("2"),
        if wet { &water } else { "" },
        rollers.collect::<String>(),
        pull.join(", "),
    )
}

/// Every scheme in a dimension: transfers beside flip in the plane alone.
fn schemes(dimension: usize) -> Vec<String> {
    let bases = ["linear", "gimp", "bspline2", "bspline3"];
    let transfers = if dimension == 2 { &["flip", "apic", "xpic2", "musl"][..] } else { &["flip"] };
    let mut all = Vec::new();
    for basis in bases {
        for remedy in ["none", "fbar-recursive", "fbar-consistent", "bbar-blocks", "bbar-patches"] {
            all.extend(transfers.iter().map(|transfer| format!("{basis}-{remedy}-{transfer}")));
        }
        for rule in ["quasi-static", "midpoint", "newmark"] {
            // In one dimension all strain is of volume, and the cells of a bar have fewer means than it has splines.
            let remedies = &["none", "fbar-consistent", "bbar", "bbar-cells"][..if dimension == 1 { 3 } else { 4 }];
            all.extend(remedies.iter().map(|remedy| format!("{rule}-{basis}-{remedy}")));
        }
    }
    for basis in &bases[..2] {
        all.extend(["two-grid", "equal", "ppp"].map(|space| format!("poro-{basis}-{space}")));
    }
    all
}

/// Why a law has no meaning with a scheme.
fn refused(law: &str, scheme: &str) -> Option<&'static str> {
    let wet = scheme.starts_with("poro");
    let implicit = ["quasi-static", "midpoint", "newmark"].iter().any(|rule| scheme.starts_with(rule));
    match law {
        "newtonian-fluid" if wet => Some("has no pores"),
        "newtonian-fluid" | "drucker-prager" | "mohr-coulomb" if implicit && !scheme.ends_with("none") => {
            Some("law without a potential")
        }
        "improved-hencky" | "cam-clay" if !wet => Some("one [water], whose porosity the law has"),
        _ => None,
    }
}

#[test]
fn every_law_runs_with_every_scheme_in_which_it_means_something() {
    let folder = tempfile::tempdir().unwrap();
    let none = Parameters::new(&[], &[]).unwrap();
    let mut runs = 0;
    for dimension in 1..=3 {
        for scheme in schemes(dimension) {
            for (k, law) in LAWS.into_iter().enumerate() {
                let path = folder.path().join(format!("{dimension}{k}{scheme}.toml"));
                std::fs::write(&path, text(dimension, law, &scheme)).unwrap();
                let what = format!("{dimension}D, {} with {scheme}", law.0);
                match (SceneFile::read(&path, 1.0, None), refused(law.0, &scheme)) {
                    (Err(e), Some(why)) => assert!(e.to_string().contains(why), "{what}: {e}"),
                    (Err(e), None) => panic!("{what}: {e}"),
                    (Ok(_), Some(why)) => panic!("{what}: {why}, and yet it begins"),
                    (Ok(scene), None) => {
                        let mut job = (scene.case.begin)(&scene.spec, &none).unwrap();
                        job.advance().unwrap_or_else(|e| panic!("{what}: {e}"));
                        runs += 1;
                    }
                }
            }
        }
    }
    assert!(runs > 500, "{runs}");
}
