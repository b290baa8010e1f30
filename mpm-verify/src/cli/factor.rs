//! The command `factor`: a scene whose strength is divided until it fails.

use super::run::Making;
use super::*;
use mpm_verify::cases::scene::SceneFile;
use mpm_verify::factor::Search;

#[derive(Args)]
pub(crate) struct Factor {
    /// Scene file in TOML with a strength: docs/how-to/factor.md
    file: PathBuf,
    /// Least factor tried
    #[arg(long, default_value_t = 1.0)]
    least: f64,
    /// Largest factor tried
    #[arg(long, default_value_t = 3.0)]
    most: f64,
    /// Trials: the least and the largest factor, then bisection
    #[arg(long, default_value_t = 9, value_parser = clap::value_parser!(u8).range(2..=40))]
    trials: u8,
    #[command(flatten)]
    pub(super) making: Making,
}

impl Factor {
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        let height = SceneFile::read(&self.file, self.least, self.making.memory())?.height;
        let mut search = Search::new([self.least, self.most], height, self.trials.into())?;
        while let Some(factor) = search.next() {
            let scene = SceneFile::read(&self.file, factor, self.making.memory())?;
            let folder = self.making.folder().map(|out| out.join(format!("{factor:.6}")));
            say(search.add(factor, &self.making.make(&scene.case, &scene.spec, folder.as_deref())?) + "\n")?;
        }
        if let Some(out) = self.making.folder() {
            let _held = hold(out)?;
            search.write(out)?;
        }
        say(search.result() + "\n").map(|()| ExitCode::Good)
    }
}
