//! Contacts with polygons and STL files.

use super::*;

/// A block on a floor that is `contact`, in space or in the plane.
fn text(axes: usize, contact: &str) -> String {
    let list = |of: &str| vec![of; axes].join(", ");
    let high = |low: &str, high: &str| [vec![low; axes - 1], vec![high]].concat().join(", ");
    format!(
        "format = 1\ntitle = \"A block\"\n[grid]\ncell_size_m = 0.5\nlower_m = [{}]\ncells = [{}]\nends = [{}]\n\
         [body]\ndensity_kg_m3 = 1000\nparticles_per_direction = 2\nvelocity_m_s = [0.5, {}]\n\
         [[body.shapes]]\nbox = {{ from_m = [{}], to_m = [{}] }}\n\
         [law.neo-hookean]\nyoung_modulus_pa = 1e5\npoisson_ratio = 0.3\n\
         [[loads]]\ngravity = {{ acceleration_m_s2 = [{}] }}\n\
         [[contacts]]\nname = \"bed\"\n{contact}\nstiffness_n_m = 2e3\nreach_m = 0.125\n\
         friction = {{ coefficient = 0.3, stiffness_n_m = 1e4 }}\n\
         [solver]\nscheme = \"gimp-none-flip\"\ncfl = 0.3\n[[phases]]\nname = \"slide\"\nduration_s = 0.2\n\
         [output]\nrow_s = 0.02\nsnapshot_rows = 5\n",
        list("0"),
        list("8"),
        list("\"open\""),
        vec!["0"; axes - 1].join(", "),
        list("1"),
        list("2"),
        high("0", "-9.81")
    )
}

const PLANE: &str = "axis = \"z\"\nend = \"lo\"\nat_m = 1.03125";
const STL: &str = "surface.stl = { file = \"bed.stl\" }";
const CORNERS: [[f32; 3]; 4] = [[-1.0, -1.0, 1.03125], [9.0, -1.0, 1.03125], [9.0, 9.0, 1.03125], [-1.0, 9.0, 1.03125]];

/// An STL file of triangles.
fn stl(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let own = |corners: &[[f32; 3]; 3]| stl_io::Triangle {
        normal: stl_io::Normal::new([0.0; 3]),
        vertices: corners.map(stl_io::Vertex::new),
    };
    let mut bytes = Vec::new();
    stl_io::write_stl(&mut bytes, triangles.iter().map(own).collect::<Vec<_>>().iter()).unwrap();
    bytes
}

fn square() -> Vec<u8> {
    let [a, b, c, d] = CORNERS;
    stl(&[[a, b, c], [c, d, a]])
}

/// A scene in a folder with a bed.
fn read(folder: &Path, text: &str, bed: &[u8]) -> Result<SceneFile, Error> {
    let path = folder.join("own.toml");
    std::fs::write(&path, text).unwrap();
    std::fs::write(folder.join("bed.stl"), bed).unwrap();
    SceneFile::read(&path, 1.0, None)
}

/// Places after two rows.
fn moved(scene: &SceneFile) -> Vec<Vec<f64>> {
    let none = Parameters::new(&[], &[]).unwrap();
    let mut job = (scene.case.begin)(&scene.spec, &none).unwrap();
    let start = places(job.as_mut());
    for _ in 0..2 {
        job.advance().unwrap();
    }
    let end = places(job.as_mut());
    assert_ne!(start, end);
    end
}

#[test]
fn a_square_of_an_stl_file_is_a_plane_face() {
    let folder = tempfile::tempdir().unwrap();
    let plane = moved(&read(folder.path(), &text(3, PLANE), &[]).unwrap());
    let mut named = square();
    named[..6].copy_from_slice(b"solid ");
    let vertex = |[x, y, z]: [f32; 3]| format!("vertex {x} {y} {z}\n");
    let [a, b, c, d] = CORNERS.map(vertex);
    let facet = |corners: [&str; 3]| format!("facet normal 0 0 1\nouter loop\n{}endloop\nendfacet\n", corners.concat());
    let in_text = format!("solid bed\n{}{}endsolid bed\n", facet([&a, &b, &c]), facet([&c, &d, &a]));
    for bed in [square(), named, in_text.into_bytes()] {
        let scene = read(folder.path(), &text(3, STL), &bed).unwrap();
        for (x, y) in moved(&scene).iter().flatten().zip(plane.iter().flatten()) {
            assert!((x - y).abs() < 1e-12, "{x} {y}");
        }
    }
}

/// By the name of its level a checkpoint knows its scene.
#[test]
fn another_file_is_another_scene() {
    let folder = tempfile::tempdir().unwrap();
    let name = |bed: &[u8]| read(folder.path(), &text(3, STL), bed).unwrap().spec.level.name;
    let first = name(&square());
    assert_eq!(name(&square()), first);
    let [a, b, c, d] = CORNERS;
    assert_ne!(name(&stl(&[[b, c, d], [d, a, b]])), first);
}

#[test]
fn a_bad_surface_is_named_with_file_line_and_key() {
    let folder = tempfile::tempdir().unwrap();
    let said = |axes: usize, contact: &str, bed: &[u8]| {
        let error = read(folder.path(), &text(axes, contact), bed).err();
        error.map_or("nothing is wrong with it".to_owned(), |e| e.to_string())
    };
    let [a, b, c, d] = CORNERS;
    let polygon = |corners: &str| format!("surface.polygon = {{ corners_m = [{corners}] }}");
    let wide = polygon("[-1, 1.03], [9, 1.03]");
    assert_eq!(said(2, &wide, &[]), "nothing is wrong with it");
    for (axes, contact, bed, parts) in [
        (3, "surface.stl = { file = \"none.stl\" }", square(), &["none.stl", "No such file"][..]),
        (3, "surface.stl = { file = \"../bed.stl\" }", square(), &["line 19", "../bed.stl", "beside the scene"]),
        (3, STL, Vec::new(), &["bed.stl", "no whole STL file"]),
        (3, STL, square()[..100].to_vec(), &["bed.stl", "no whole STL file"]),
        (3, STL, stl(&[]), &["bed.stl", "facets of a mesh = 0"]),
        (3, STL, stl(&[[a, b, c], [a, a, b]]), &["bed.stl", "1 is not allowed: one with an area"]),
        (3, STL, stl(&[[a, b, [f32::NAN; 3]]]), &["bed.stl", "finite"]),
        (
            3,
            STL,
            stl(&[[a, b, c], [a, c, d], [a, d, [0.0; 3]], [a, [1.0; 3], d]]),
            &["3 is not allowed: one with at most"],
        ),
        (3, STL, stl(&[[a, b, c], [c, a, d]]), &["1 is not allowed: one with at most one other at an edge"]),
        (2, STL, square(), &["line 19", "stl where the grid has 2 axes", "3 are allowed"]),
        (3, &wide, Vec::new(), &["line 19", "polygon where the grid has 3 axes", "2 are allowed"]),
        (2, &polygon("[-1, 1]"), Vec::new(), &["line 19", "facets of a mesh = 0"]),
        (2, &polygon("[-1, 1], [-1, 1], [9, 1]"), Vec::new(), &["line 19", "0 is not allowed: one with an area"]),
        (2, &polygon("[-1, 1], [9, 1, 3]"), Vec::new(), &["line 19", "a corner has 3 numbers", "2 axes"]),
        (2, &polygon("[-1, 1], [9, inf]"), Vec::new(), &["inf where a finite number"]),
        (2, &format!("{wide}\nat_m = 3"), Vec::new(), &["line 19", "a surface beside axis, end, at_m or within"]),
        (2, &format!("{wide}\nwithin = {{ x_m = [0, 1] }}"), Vec::new(), &["a surface beside axis"]),
        (2, "axis = \"y\"\nend = \"lo\"", Vec::new(), &["line 19", "axis, end and at_m, or a surface"]),
        (2, "surface.polygone = { corners_m = [] }", Vec::new(), &["polygone", "is `polygon` meant?"]),
        // The block is below it.
        (2, &polygon("[-1, 3.03], [9, 3.03]"), Vec::new(), &["phase slide", "gap to a rigid body closes"]),
    ] {
        let said = said(axes, contact, &bed);
        assert!(said.contains(folder.path().to_str().unwrap()), "{said}");
        for part in parts {
            assert!(said.contains(part), "{part} in: {said}");
        }
    }
}

#[test]
fn pictures_show_a_polygon_where_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let contact = "surface.polygon = { corners_m = [[-1, 1.03], [3, 1.03], [9, 0.5]] }\nvelocity_m_s = [0.5, -1]";
    let scenery = read(folder.path(), &text(2, contact), &[]).unwrap().case.scenery.unwrap();
    for time in [0.0, 0.1, 0.2] {
        let around = (scenery.around)(time);
        let (line, is_support) = around.last().unwrap();
        assert!(*is_support && line.len() == 3, "{around:?}");
        let sought = [(-1.0, 1.03), (3.0, 1.03), (9.0, 0.5)].map(|(x, y)| (x + 0.5 * time, y - time));
        let apart = line.iter().zip(sought).map(|(p, q)| (p.0 - q.0).abs() + (p.1 - q.1).abs());
        assert!(apart.fold(0.0, f64::max) < 1e-12, "{line:?}");
    }
}

/// Kept as its file has it, and read again.
#[test]
fn a_filled_scene_has_its_surface() {
    let folder = tempfile::tempdir().unwrap();
    let filled = read(folder.path(), &text(3, STL), &square()).unwrap().case.scenery.unwrap().filled;
    assert!(filled.contains("file = \"bed.stl\"") && !filled.contains("at_m"), "{filled}");
    assert_eq!(read(folder.path(), &filled, &square()).unwrap().case.scenery.unwrap().filled, filled);
}

/// The bed bears the weight while it holds the sand. On its steep part, from 0.3 to 0.9 s after the sand is let go, nearly
/// all of it slips: the force along the bed is μ times that across it, and less where some of it sticks still.
#[test]
fn sand_slides_on_bedrock_as_coulomb_has_it() {
    let (rows, particles) = bodies::rows_of(&shipped("sand-on-bedrock.toml"), 160);
    let sum = |range: std::ops::Range<usize>| {
        let count = range.len() as f64;
        let of = |name: &str| {
            rows[range.clone()].iter().map(|row| bodies::last(std::slice::from_ref(row), name)).sum::<f64>()
        };
        ["bed_x (N/m)", "bed_y (N/m)"].map(|name| of(name) / count)
    };
    let column = |name: &str| &particles.iter().find(|column| column.name == name).unwrap().values;
    let weight = 631.0 * 0.125 * 0.125 * 1800.0 * 9.81;
    assert_eq!(column("x").len(), 631);
    let [_, held] = sum(30..40);
    assert!((-held / weight - 1.0).abs() < 0.05, "{held} of {weight}");
    let [x, y] = sum(46..58);
    let (along, across) = ([12.14, -5.22], [5.22, 12.14]);
    let share = (along[0] * x + along[1] * y) / (across[0] * x + across[1] * y) / -0.3;
    assert!((0.9..=1.0).contains(&share), "{share}");
    let bed = [[-1.0, 10.72], [11.14, 5.5], [15.0, 4.9], [18.0, 3.7], [33.0, 2.4]];
    for (x, y) in column("x").iter().zip(column("y")) {
        let side = bed.windows(2).find(|side| *x <= side[1][0]).unwrap();
        let height = side[0][1] + (x - side[0][0]) * (side[1][1] - side[0][1]) / (side[1][0] - side[0][0]);
        assert!(*y > height, "{x} {y}");
    }
    // Its front has passed the last kink, and is on the bed still.
    let front = column("x").iter().copied().fold(0.0, f64::max);
    assert!((18.0..32.0).contains(&front), "{front}");
}
