//! Progress, in lines on standard error.

use mpm_verify::error::{Error, one_line};
use mpm_verify::record::Record;
use mpm_verify::report::describe;
use mpm_verify::run::Progress;
use mpm_verify::study::schedule::Listener;
use std::fmt::Display;
use std::io::Write;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering::Relaxed};
use std::time::Instant;

/// Seconds until the first line, and the longest interval between lines; each interval is twice the one before.
const FIRST_S: u64 = 5;
const LEAST_OFTEN_S: u64 = 600;

fn say(line: impl Display) {
    // Nothing more can be done if stderr is closed.
    let _ = writeln!(anstream::stderr(), "{line}");
}

/// Says how far something has come, now and then.
pub(crate) struct Teller {
    name: String,
    shown: bool,
    begun: Instant,
    /// When the next line is due (s).
    next: AtomicU64,
}

impl Teller {
    pub(crate) fn new(name: &str, shown: bool) -> Self {
        Self { name: name.to_owned(), shown, begun: Instant::now(), next: AtomicU64::new(FIRST_S) }
    }

    /// Says a text made of the seconds so far, if a line is due.
    pub(crate) fn hear(&self, text: impl FnOnce(f64) -> String) {
        let (seconds, next) = (self.begun.elapsed().as_secs_f64(), self.next.load(Relaxed));
        if self.shown && seconds >= next as f64 {
            let later = (2 * next).min(next + LEAST_OFTEN_S);
            if self.next.compare_exchange(next, later, Relaxed, Relaxed).is_ok() {
                say(format!("{}: {}", self.name, text(seconds)));
            }
        }
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
    let (of, name) = units.into_iter().find(|(of, _)| seconds >= *of).unwrap_or((1.0, "s"));
    format!("{:.1} {name}", seconds / of)
}

/// The progress of runs side by side: a line as each ends.
pub(crate) struct Runs {
    names: Vec<String>,
    ended: AtomicUsize,
    shown: bool,
}

impl Runs {
    pub(crate) fn new(names: Vec<String>, shown: bool) -> Self {
        Self { names, ended: AtomicUsize::new(0), shown }
    }
}

impl Listener for Runs {
    fn begins_again(&self, run: usize, why: &Error) {
        if self.shown {
            say(format!("{}  begins again: {}", self.names[run], one_line(&why.to_string())));
        }
    }

    fn ended(&self, run: usize, record: &Record) {
        let (count, all) = (self.ended.fetch_add(1, Relaxed) + 1, self.names.len());
        if self.shown {
            let outcome = describe::outcome_word(record);
            say(format!("[{count}/{all}] {}  {outcome}  {:.1} s", self.names[run], record.time.wall_s));
        }
    }
}
