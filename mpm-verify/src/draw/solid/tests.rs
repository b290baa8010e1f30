use super::*;

fn figure(panels: Vec<SolidPanel>, columns: usize) -> SolidFigure {
    SolidFigure {
        title: "A slope".into(),
        panels,
        columns,
        range: (0.0, 2.0),
        label: "equivalent plastic strain (-)".into(),
        camera: Camera {
            azimuth: 35.0,
            elevation: 28.0,
            up: Up::Y,
        },
        axes: ["x (m)", "y (m)", "z (m)"].map(str::to_owned),
        window: Some([(0.0, 30.0), (0.0, 5.0), (0.0, 5.0)]),
    }
}

/// A block of cells' particles on the ground, all of one value.
fn block(count: [usize; 3], value: f64) -> SolidPanel {
    let [nx, ny, nz] = count;
    let place = |n: usize| [n / (ny * nz), n / nz % ny, n % nz].map(|k| k as f64 + 0.5);
    SolidPanel {
        title: "block".into(),
        points: (0..nx * ny * nz).map(place).collect(),
        values: vec![value; nx * ny * nz],
        size: 1.0,
    }
}

/// The image of particles from the front, ten pixels to a metre, with x from -5 m and y up to 25 m.
fn from_the_front(points: &[[f64; 3]], colours: &[Rgb], size: f64) -> image::RgbImage {
    let camera = Camera {
        azimuth: 0.0,
        elevation: 0.0,
        up: Up::Y,
    };
    let screen = Screen {
        view: View::new(camera),
        corner: (-5.0, 25.0),
        scale: 10.0,
        size: (400, 300),
    };
    let cloud = Cloud {
        points,
        colours,
        size,
    };
    surface::draw(&cloud, &screen, None)
}

/// The hue and saturation of a colour: its channels over the largest.
fn hue([r, g, b]: [u8; 3]) -> [f64; 3] {
    let most = f64::from(r.max(g).max(b));
    [r, g, b].map(|c| f64::from(c) / most)
}

fn same_hue(pixel: &image::Rgb<u8>, colour: Rgb) -> bool {
    let [_, r, g, b] = colour.to_be_bytes();
    let pairs = hue(pixel.0).into_iter().zip(hue([r, g, b]));
    pairs.into_iter().all(|(a, b)| (a - b).abs() < 0.02)
}

#[test]
fn a_nearer_particle_hides_a_farther_one() {
    let (near, far) = ([10.0, 10.0, 3.0], [10.5, 10.0, 0.0]);
    let (red, blue) = (0xC04020, 0x2040C0);
    for (points, colours) in [([near, far], [red, blue]), ([far, near], [blue, red])] {
        let image = from_the_front(&points, &colours, 1.0);
        // Each about its own middle, and the nearer where both are.
        assert!(same_hue(image.get_pixel(150, 150), red));
        assert!(same_hue(image.get_pixel(156, 150), red));
        assert!(same_hue(image.get_pixel(163, 150), blue));
        assert_eq!(image.get_pixel(150, 100).0, [255; 3]);
        assert_eq!(image.get_pixel(170, 150).0, [255; 3]);
    }
}

#[test]
fn a_plane_is_lit_evenly_in_the_colour_of_its_value() {
    let panel = block([30, 20, 8], 0.5);
    let colour = stone_of(0.5, (0.0, 2.0));
    let colours = vec![colour; panel.points.len()];
    let image = from_the_front(&panel.points, &colours, 1.0);
    // From x = 5 m to 25 m and y = 5 m to 15 m.
    let inner = image::imageops::crop_imm(&image, 100, 100, 200, 100).to_image();
    let levels = inner.pixels().map(|p| p.0[0]);
    let (least, most) = levels.fold((255, 0), |(lo, hi), v| (v.min(lo), v.max(hi)));
    assert!(most - least <= 3, "{least} to {most}");
    assert!(inner.pixels().all(|p| same_hue(p, colour)));
}

#[test]
fn pixels_follow_from_the_input_alone() {
    let folder = tempfile::tempdir().unwrap();
    let mut small = figure(vec![block([6, 2, 3], 1.0), block([3, 1, 2], f64::NAN)], 2);
    small.window = Some([(0.0, 30.0), (0.0, 2.0), (0.0, 3.0)]);
    let draw = |threads: usize| {
        let path = folder.path().join(format!("{threads}.png"));
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().unwrap();
        pool.install(|| draw_solids(&path, &small)).unwrap();
        std::fs::read(path).unwrap()
    };
    assert!(draw(1) == draw(3));
    let frames = [small.clone(), small.clone()];
    animate_solids(&folder.path().join("moving.png"), &frames, 8).unwrap();
}

#[test]
fn what_is_not_there_to_be_drawn_is_an_error() {
    let path = Path::new("no such folder/picture.png");
    let none = |figure: &SolidFigure, name: &str| {
        let error = draw_solids(path, figure).unwrap_err();
        assert!(matches!(error, PlotError::NoFiniteData { .. }), "{error}");
        assert!(error.to_string().contains(name), "{error}");
    };
    none(&figure(Vec::new(), 1), "A slope");
    let mut empty = block([1, 1, 1], 0.0);
    empty.points[0][2] = f64::NAN;
    none(&figure(vec![empty.clone()], 1), "block");
    let mut windowless = figure(vec![empty], 1);
    windowless.window = None;
    none(&windowless, "A slope");
    let mut beyond = figure(vec![block([2, 2, 2], 0.0)], 1);
    beyond.window = Some([(10.0, 20.0), (0.0, 5.0), (0.0, 5.0)]);
    none(&beyond, "block");
    for spoil in [
        |f: &mut SolidFigure| f.range = (f64::NAN, f64::NAN),
        |f: &mut SolidFigure| f.camera.azimuth = f64::NAN,
        |f: &mut SolidFigure| f.window = Some([(0.0, 1.0), (1.0, 1.0), (0.0, 1.0)]),
    ] {
        let mut spoilt = figure(vec![block([2, 2, 2], 0.0)], 1);
        spoil(&mut spoilt);
        none(&spoilt, "A slope");
    }
    let mut short = block([2, 2, 2], 0.0);
    short.values.pop();
    let error = draw_solids(path, &figure(vec![short], 1)).unwrap_err();
    assert!(matches!(
        error,
        PlotError::Lengths {
            points: 8,
            values: 7,
            ..
        }
    ));
}
