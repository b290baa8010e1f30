//! The pictures that README and docs show, each with what it is drawn from.

use super::prelude::*;
use super::rows::RESULTS;
use super::speed::Speed;
use super::{board, convergence, draw_own, rows, solvers, sweep, together};
use crate::files::read;
use image::imageops::{self, FilterType};
use std::fs;

/// Most bytes of a picture.
const MOST: u64 = 150_000;
/// Fewer pixels than these across leave no text legible.
const LEAST_WIDTH: u32 = 500;
/// Step of a colour channel of a picture that is too large.
const SHADE: u8 = 17;
/// Where they lie, below the repository.
const PLACE: &str = "docs/pictures";

/// Errors that the pages' tables tell of: five rows of panels would be too many.
const IN_TABLES: [&str; 3] = ["displacement_linf", "velocity_l2", "stress_l2"];

/// Folder, which is a case's or the board's, and file, both of the report and of the pages; charts are SVG or, if too large, PNG. The third cell
/// is [`ROWS`], [`CODES`], a script or the least tier of the runs.
const SHOWN: &str = include_str!("../../assets/pictures.csv");
/// Kept rows of nights: a row per run.
const ROWS: &str = "rows";
/// Kept results of other codes.
const CODES: &str = "codes";

fn shown() -> impl Iterator<Item = [&'static str; 3]> {
    SHOWN.lines().skip(1).filter_map(|line| line.split(',').collect::<Vec<_>>().try_into().ok())
}

/// The files of all pictures, below the repository.
pub fn files() -> impl Iterator<Item = PathBuf> {
    shown().map(|[folder, file, _]| Path::new(PLACE).join(folder).join(file))
}

/// Draws the pictures of the repository at `root` anew: from its rows and results of other codes, and those that the
/// finished runs in `folders`, shards of one plan, suffice for. The others are left as they are. Returns a line on each.
///
/// # Errors
/// Rows, results or runs are missing or damaged, or a picture can't be drawn, can't be written or is too large.
pub fn draw(root: &Path, folders: &[PathBuf]) -> Result<String, Error> {
    let drawn = tempfile::tempdir().map_err(|e| Error::Input(format!("temporary folder: {e}")))?;
    let drawn = drawn.path();
    draw_rows(&root.join(RESULTS), drawn)?;
    let codes = root.join("mpm-verify/codes");
    if codes.exists() {
        let kept: Vec<Record> = rows::read(&root.join(RESULTS))?.iter().filter_map(rows::Row::record).collect();
        board::write(&board::among(&[codes], &kept)?, &drawn.join("board"))?;
    }
    let tier = match folders {
        [] => None,
        _ => Some(draw_runs(folders, drawn)?),
    };
    let mut told = String::new();
    for [folder, file, source] in shown() {
        let (from, to) = (drawn.join(folder), root.join(PLACE).join(folder));
        let (suffices, wanted) = match source {
            ROWS => (true, "rows of runs".to_owned()),
            script if script.ends_with(".py") => (false, format!("a run of {script}")),
            CODES => (true, "results of other codes".to_owned()),
            least => (tier >= Some(Tier::parse(least)?), format!("runs of tier {least}: --from")),
        };
        let line = if !(suffices && from.join(file).exists()) {
            format!("left, for want of {wanted}")
        } else {
            make_folder(&to)?;
            place(&from.join(file), &to.join(file))?;
            "drawn".to_owned()
        };
        told += &format!("{folder}/{file}: {line}\n");
    }
    Ok(told)
}

/// Draws errors over cell size, cost and swept parameters of every case that has rows.
fn draw_rows(results: &Path, out: &Path) -> Result<(), Error> {
    let mut records: Vec<Record> = rows::read(results)?.iter().filter_map(rows::Row::record).collect();
    let none = |_: &Record| Err(Error::Input("a kept row has no folder".to_owned()));
    let mut gallery = Gallery::new("results", &records, &none, out);
    together::draw(&mut gallery)?;
    solvers::draw(&mut gallery)?;
    for record in &mut records {
        record.metrics.retain(|name, _| !IN_TABLES.contains(&&**name));
    }
    let mut studies = Vec::new();
    for case in cases::all() {
        let of_case = records.iter().filter(|r| r.case == case.name);
        let mut study = CaseStudy::new(case.name, of_case.cloned().collect());
        if shown().any(|[name, _, of]| name == case.name && of == ROWS) && !study.records.is_empty() {
            study.convergence = convergence(case, &study.records);
            convergence::draw(&study, out)?;
            sweep::draw(&study, out)?;
        }
        studies.push(study);
    }
    Speed::of(&studies).draw(&out.join("results"))?;
    Ok(())
}

/// Draws what the cases draw of their runs; returns the runs' tier.
fn draw_runs(folders: &[PathBuf], out: &Path) -> Result<Tier, Error> {
    let gathered = Gathered::read(folders)?;
    let found = gathered.judge(|_| Ok(Vec::new()))?;
    let tier = Tier::parse(&found.tier)?;
    for study in &found.cases {
        draw_own(cases::find(&study.case)?, study, &gathered, out)?;
    }
    Ok(tier)
}

/// Puts a picture into its place; pixels are made fewer until they fit. One of the same name in the other format goes.
fn place(from: &Path, to: &Path) -> Result<(), Error> {
    let bytes = read(from, DOCUMENT)?;
    let is_png = to.extension().is_some_and(|e| e == "png");
    if bytes.len() as u64 <= MOST {
        write_whole(to, &bytes)?;
    } else if is_png {
        fit(&image::load_from_memory(&bytes).map_err(|e| Error::file(from, e))?.to_rgb8(), to)?;
    } else {
        return Err(Error::file(to, format!("{} bytes where {MOST} are allowed", bytes.len())));
    }
    discard(&to.with_extension(if is_png { "svg" } else { "png" }))
}

/// Writes a picture with as many of its pixels as fit, in few shades: noise has too many.
fn fit(picture: &RgbImage, to: &Path) -> Result<(), Error> {
    let draft = tempfile::NamedTempFile::new().map_err(|e| Error::file(to, e))?;
    let mut share = 1.0;
    loop {
        let [width, height] = [picture.width(), picture.height()].map(|n| (share * f64::from(n)) as u32);
        if width < LEAST_WIDTH {
            return Err(Error::file(to, format!("more than {MOST} bytes even {width} pixels wide")));
        }
        let mut small = imageops::resize(picture, width, height, FilterType::Triangle);
        for channel in small.iter_mut() {
            *channel = (channel.saturating_add(SHADE / 2)) / SHADE * SHADE;
        }
        write_small_png(draft.path(), &small)?;
        let bytes = fs::read(draft.path()).map_err(|e| Error::file(to, e))?;
        if bytes.len() as u64 <= MOST {
            return write_whole(to, &bytes);
        }
        share *= 0.95;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEPT: &str = "\
case,scheme,level,set,h,status,right,wrong_as_known,not_judged,failed,particles,steps,particle_node_pairs,cpu_s,night,program,metrics
cook,gimp-none-flip,h2,,2,ok,3,1,0,0,1448,7026,183125664,0.452,2026-01-01,now,fem_edge_mean_error=-0.15
cook,gimp-none-flip,h1,,1,ok,3,1,0,0,1448,7026,183125664,0.9,2026-01-01,now,fem_edge_mean_error=-0.08
";

    #[test]
    fn what_there_is_is_drawn_and_the_rest_is_named_and_left() {
        let root = tempfile::tempdir().unwrap();
        let shown = |file: &str| root.path().join(PLACE).join(file);
        crate::files::write_whole(&root.path().join("reports/nightly/results.csv"), KEPT.as_bytes()).unwrap();
        crate::files::write_whole(&shown("column/creep.svg"), b"former").unwrap();
        let told = draw(root.path(), &[]).unwrap();
        let (drawn, left): (Vec<&str>, Vec<&str>) = told.lines().partition(|line| line.ends_with(": drawn"));
        assert_eq!(drawn, ["cook/convergence.svg: drawn"], "{told}");
        assert_eq!(left.len(), super::shown().count() - 1);
        assert!(told.contains("column/creep.svg: left, for want of runs of tier pr"));
        assert!(told.contains("board/board.svg: left, for want of results of other codes"));
        let svg = fs::read_to_string(shown("cook/convergence.svg")).unwrap();
        assert!(svg.starts_with("<svg"));
        assert_eq!(fs::read(shown("column/creep.svg")).unwrap(), b"former");
        assert!(!shown("cook/convergence.png").exists());
    }

    #[test]
    fn what_the_tables_tell_is_measured() {
        let errors = &cases::find("mms-axis").unwrap().quantities;
        for name in IN_TABLES {
            assert!(errors.iter().any(|q| q.metric.name == name), "{name}");
        }
    }

    #[test]
    fn a_picture_that_is_too_large_has_fewer_pixels_and_a_chart_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let [from, chart, field] = ["from", "a.svg", "a.png"].map(|name| folder.path().join(name));
        // Noise: no file of it is small.
        let mut random = fastrand::Rng::with_seed(1);
        let noise = RgbImage::from_fn(600, 300, |_, _| image::Rgb([(); 3].map(|()| random.u8(..))));
        noise.save_with_format(&from, image::ImageFormat::Png).unwrap();
        assert!(fs::metadata(&from).unwrap().len() > MOST);
        assert!(place(&from, &chart).is_err() && !chart.exists());
        assert!(place(&from, &field).is_err());
        let smooth = RgbImage::from_fn(1200, 600, |x, y| image::Rgb([(x / 5) as u8, (y / 3) as u8, random.u8(..2)]));
        smooth.save_with_format(&from, image::ImageFormat::Png).unwrap();
        fs::write(&chart, "former").unwrap();
        place(&from, &field).unwrap();
        assert!(fs::metadata(&field).unwrap().len() <= MOST && !chart.exists());
        assert!(image::open(&field).unwrap().width() <= 1200);
    }
}
