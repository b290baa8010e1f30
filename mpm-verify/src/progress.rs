//! Progress: bars on a terminal, plain lines otherwise.

use anstream::adapter::strip_str;
use anstream::{AutoStream, ColorChoice};
use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use mpm_verify::error::{Error, one_line};
use mpm_verify::record::Record;
use mpm_verify::report::describe;
use mpm_verify::run::Progress;
use mpm_verify::study::schedule::Listener;
use std::io::{self, IsTerminal, Write};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::time::Instant;

/// Positions of a full bar.
pub(crate) const SCALE: f64 = 1000.0;

fn style() -> ProgressStyle {
    ProgressStyle::with_template("{bar:30} {percent:>3} %  {msg}  {elapsed}")
        .unwrap_or_else(|_| ProgressStyle::default_bar())
}

/// A bar for one run; hidden unless `shown`, and where stderr is no terminal.
pub(crate) fn single(message: &str, shown: bool) -> ProgressBar {
    let bar = match shown {
        true => ProgressBar::new(SCALE as u64).with_style(style()),
        false => ProgressBar::hidden(),
    };
    bar.set_message(message.to_owned());
    bar
}

/// Seconds until the first progress line of a run without a terminal, and the longest interval between lines; each
/// interval is twice the one before.
const FIRST_S: u64 = 10;
const LEAST_OFTEN_S: u64 = 600;

/// Says how far one run has come: a bar on a terminal, else a line now and then.
pub(crate) struct Teller {
    name: String,
    bar: ProgressBar,
    lines: bool,
    begun: Instant,
    /// When the next line is due (s).
    next: AtomicU64,
}

impl Teller {
    pub(crate) fn new(name: &str, shown: bool) -> Self {
        Self {
            name: name.to_owned(),
            bar: single(name, shown),
            lines: shown && !io::stderr().is_terminal(),
            begun: Instant::now(),
            next: AtomicU64::new(FIRST_S),
        }
    }

    /// Hears how far the run has come.
    pub(crate) fn hear(&self, now: Progress) {
        let seconds = self.begun.elapsed().as_secs_f64();
        let text = so_far(now, seconds);
        self.bar.set_position((now.share * SCALE) as u64);
        self.bar.set_message(format!("{}  {text}", self.name));
        let next = self.next.load(Relaxed);
        if self.lines && seconds >= next as f64 {
            let later = (2 * next).min(next + LEAST_OFTEN_S);
            let mine = self.next.compare_exchange(next, later, Relaxed, Relaxed);
            if mine.is_ok() {
                // Nothing more can be done if stderr is closed.
                let _ = writeln!(io::stderr(), "{}: {text}", self.name);
            }
        }
    }

    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// Progress of a run after `seconds`, and the time left at the rate of this machine.
pub(crate) fn so_far(now: Progress, seconds: f64) -> String {
    let rate = now.steps as f64 / seconds;
    let mut text = format!("step {}, t = {:.4e} s, {rate:.0} steps/s", now.steps, now.time);
    if now.share > 0.0 {
        let left = seconds * (1.0 / now.share - 1.0);
        text += &format!(", {:.0} %, at most {} left", 100.0 * now.share, lasting(left));
    }
    text
}

/// A time in words.
fn lasting(seconds: f64) -> String {
    let units = [(86400.0, "d"), (3600.0, "h"), (60.0, "min")];
    let unit = units.into_iter().find(|(of, _)| seconds >= *of);
    let (of, name) = unit.unwrap_or((1.0, "s"));
    format!("{:.1} {name}", seconds / of)
}

/// The progress of runs side by side.
pub(crate) struct Runs {
    names: Vec<String>,
    bars: MultiProgress,
    running: Mutex<Vec<Option<ProgressBar>>>,
    ended: Mutex<usize>,
    terminal: bool,
    shown: bool,
}

impl Runs {
    pub(crate) fn new(names: Vec<String>, shown: bool) -> Self {
        let terminal = io::stderr().is_terminal();
        let bars = MultiProgress::new();
        if !(terminal && shown) {
            bars.set_draw_target(ProgressDrawTarget::hidden());
        }
        Self { running: Mutex::new(vec![None; names.len()]), ended: Mutex::new(0), names, bars, terminal, shown }
    }

    pub(crate) fn finish(&self) {
        // A terminal that can't be cleared is no reason to fail.
        let _ = self.bars.clear();
    }

    fn say(&self, line: &str) {
        if !self.shown {
            return;
        }
        if !self.terminal {
            let _ = writeln!(anstream::stderr(), "{line}");
        } else if AutoStream::choice(&io::stderr()) == ColorChoice::Never {
            let _ = self.bars.println(strip_str(line).to_string());
        } else {
            let _ = self.bars.println(line);
        }
    }
}

impl Listener for Runs {
    fn progress(&self, run: usize, share: f64) {
        if let Ok(mut running) = self.running.lock() {
            let bar = running[run].get_or_insert_with(|| self.bars.add(single(&self.names[run], self.shown)));
            bar.set_position((share * SCALE) as u64);
        }
    }

    fn begins_again(&self, run: usize, why: &Error) {
        self.say(&format!("{}  begins again: {}", self.names[run], one_line(&why.to_string())));
    }

    fn ended(&self, run: usize, record: &Record) {
        let count = self.ended.lock().map_or(0, |mut ended| {
            *ended += 1;
            *ended
        });
        let line = format!(
            "[{count}/{}] {}  {}  {:.1} s",
            self.names.len(),
            self.names[run],
            describe::outcome_word(record),
            record.time.wall_s
        );
        let bar = self.running.lock().ok().and_then(|mut r| r[run].take());
        if let Some(bar) = bar {
            bar.finish_and_clear();
        }
        self.say(&line);
    }
}
