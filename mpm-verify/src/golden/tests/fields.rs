//! Fields of particles.

use super::*;

/// A particle of the field may move by half a pixel, its colour by half a step.
#[test]
fn the_field_of_the_first_run_is_kept_and_compared() {
    let made = Made::of(0);
    let [file, picture] = field::files(&made.goldens(), "cook");
    assert_eq!([&file, &picture], [&made.goldens().join("cook-field.csv"), &made.goldens().join("cook-field.png")]);
    let text = fs::read_to_string(&file).unwrap();
    let rows: Vec<&str> = text.lines().collect();
    // That beside the window is not kept; those on its edge are.
    assert_eq!(rows, ["particle,x (m),y (m),value", "0,10,10,-1", "1,20,30,0", "3,0,60,1"]);
    let (pixel, colour) = (60.0 / 240.0, 2.0 / 16.0);
    let view = cases::find("cook").unwrap().field.unwrap();
    let differ = || {
        let files = [file.clone(), picture.clone()];
        let found = field::judge(&files, &view, &made.record, made.folder.path(), "");
        found.unwrap()[0].value
    };
    for (column, moved, differing) in [
        (0, 0.49 * pixel, 0.0),
        (0, -0.51 * pixel, 1.0),
        (1, 0.51 * pixel, 1.0),
        (1, -0.49 * pixel, 0.0),
        (3, 0.51 * colour, 1.0),
        (3, -0.49 * colour, 0.0),
        (3, f64::NAN, 1.0),
    ] {
        let mut particles = Made::particles();
        particles[column].1[1] += moved;
        made.write("particles.csv", &particles);
        assert_eq!(differ(), Some(differing), "{column} {moved}");
    }
    // A pixel is a share of what is shown, wherever that begins.
    let shown = [(8.0, 32.0), (6.0, 36.0)];
    let view = crate::case::FieldView { window: shown, range: (-2.0, 1.0), ..view };
    let files = ["part.csv", "part.png"].map(|name| made.folder.path().join(name));
    made.write("particles.csv", &Made::particles());
    field::bless(&files, &view, &made.record, made.folder.path()).unwrap();
    for (column, step) in [(0, 30.0 / 240.0), (1, 30.0 / 240.0), (3, 3.0 / 16.0)] {
        for (share, differing) in [(0.49, 0.0), (0.51, 1.0)] {
            let mut particles = Made::particles();
            particles[column].1[1] += share * step;
            made.write("particles.csv", &particles);
            let found = field::judge(&files, &view, &made.record, made.folder.path(), "").unwrap();
            assert_eq!(found[0].value, Some(differing), "{column} {share}");
        }
    }
    let mut particles = Made::particles();
    particles[3].1 = vec![0.0; 4];
    made.write("particles.csv", &particles);
    let drift = made.drift();
    assert_eq!((drift.len(), drift[0].1), (2, Some(2.0)));
    assert_eq!(drift[1].0, "different pixels of the field");
    assert!(drift[1].1 > Some(0.0));
    // Particles that are gone differ.
    let fewer = Made::particles().map(|(name, values)| (name, values[..1].to_vec()));
    made.write("particles.csv", &fewer);
    assert_eq!(differ(), Some(2.0));
    made.write("particles.csv", &Made::particles()[..3]);
    let goldens = Goldens::open(&made.goldens()).unwrap();
    let said = goldens.compare(&made.record, made.folder.path()).unwrap_err().to_string();
    assert!(said.contains("particles.csv") && said.contains("no column mean_stress"), "{said}");

    made.write("particles.csv", &Made::particles());
    let mut other = read_picture(&picture).unwrap();
    other.put_pixel(5, 5, Rgb([9; 3]));
    write_small_png(&picture, &other).unwrap();
    let drift = made.drift();
    assert_eq!((drift.len(), drift[0].1), (1, Some(1.0)));
    fs::remove_file(&picture).unwrap();
    assert!(made.drift()[0].2.contains("cook-field.png"));
    for damaged in [rows[0].to_owned() + "\n", text.replace("value", "stress"), text[..40].to_owned()] {
        fs::write(&file, damaged).unwrap();
        assert!(made.drift()[0].2.contains("cook-field.csv"), "{:?}", made.drift());
    }
}
