//! Progress: bars on a terminal, plain lines otherwise.

use anstream::adapter::strip_str;
use anstream::{AutoStream, ColorChoice};
use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use mpm_verify::error::{Error, one_line};
use mpm_verify::record::Record;
use mpm_verify::report::describe;
use mpm_verify::study::schedule::Listener;
use std::io::{self, IsTerminal, Write};
use std::sync::Mutex;

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
        Self {
            running: Mutex::new(vec![None; names.len()]),
            ended: Mutex::new(0),
            names,
            bars,
            terminal,
            shown,
        }
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
            let bar = running[run]
                .get_or_insert_with(|| self.bars.add(single(&self.names[run], self.shown)));
            bar.set_position((share * SCALE) as u64);
        }
    }

    fn begins_again(&self, run: usize, why: &Error) {
        self.say(&format!(
            "{}  begins again: {}",
            self.names[run],
            one_line(&why.to_string())
        ));
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
