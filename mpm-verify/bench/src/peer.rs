//! Other programs that do the same step, each a process that takes its turns on command.

use crate::measured::Sample;
use crate::turn::{Error, Outcome, Timed, Turn};
use crate::workload::{Block, REMEDIES, STEPS, standard};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// Peers that are written in Taichi.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Peers {
    /// The Python interpreter that has Taichi.
    pub python: PathBuf,
    /// The program.
    pub script: PathBuf,
}

/// The answer to a slice.
#[derive(Debug, Clone, Copy, Deserialize)]
struct Took {
    wall_s: f64,
    cpu_s: f64,
}

/// The line with which a peer begins.
#[derive(Debug, Deserialize)]
struct Ready {
    #[serde(rename = "ready")]
    _program: String,
}

/// A running peer.
struct Peer {
    name: String,
    child: Child,
    commands: ChildStdin,
    answers: BufReader<ChildStdout>,
    particles: u64,
}

/// Where the program lies in the workspace.
const SCRIPT: &str = "mpm-verify/benches/peers/taichi_mpm.py";

impl Peers {
    /// Taichi, run by a Python interpreter that has it.
    #[must_use]
    pub fn taichi(python: PathBuf) -> Self {
        let script = PathBuf::from(SCRIPT);
        Self { python, script }
    }

    /// Idiomatic and tuned Taichi of every workload on each number of threads, to be the same as those that are there.
    pub(super) fn turns(&self, threads: &[usize], turns: &mut Vec<Turn>) -> Result<(), Error> {
        for remedy in REMEDIES.into_iter().take(2) {
            self.turns_of(standard::<2>(remedy), threads, turns)?;
            self.turns_of(standard::<3>(remedy), threads, turns)?;
        }
        Ok(())
    }

    fn turns_of<const D: usize>(&self, block: Block<D>, threads: &[usize], turns: &mut Vec<Turn>) -> Result<(), Error> {
        let like = turns.iter().position(|t| t.name == block.name());
        for way in ["tuned", "idiomatic"] {
            for &threads in threads {
                let name = format!("{} Taichi {way}", block.name());
                let peer = self.start(&name, block, way == "tuned", threads)?;
                turns.push(Turn {
                    group: "peer",
                    name,
                    threads,
                    particles: block.particles(),
                    timed: Box::new(peer),
                    like,
                });
            }
        }
        Ok(())
    }

    fn start<const D: usize>(&self, name: &str, block: Block<D>, tuned: bool, threads: usize) -> Result<Peer, Error> {
        require_file(&self.script)?;
        let failed = |e: std::io::Error| {
            format!(
                "{}: {e}; --python must name an interpreter that has what {} asks for",
                self.python.display(),
                self.script.with_file_name("requirements.txt").display()
            )
        };
        let mut command = Command::new(&self.python);
        command.arg(&self.script);
        command.args(["--dimension", &D.to_string()]);
        command.args(["--cells", &block.cells.to_string()]);
        command.args(["--threads", &threads.to_string()]);
        command.args((block.remedy != REMEDIES[0]).then_some("--fbar"));
        command.args(tuned.then_some("--tuned"));
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().map_err(failed)?;
        let (Some(commands), Some(answers)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(failed(std::io::ErrorKind::BrokenPipe.into()).into());
        };
        let mut peer = Peer {
            name: name.to_owned(),
            child,
            commands,
            answers: BufReader::new(answers),
            particles: block.particles(),
        };
        peer.answer::<Ready>()?;
        Ok(peer)
    }
}

fn require_file(path: &Path) -> Result<(), Error> {
    match path.is_file() {
        true => Ok(()),
        false => {
            let cause = "not there: run from the folder of the workspace";
            Err(format!("{}: {cause}", path.display()).into())
        }
    }
}

impl Peer {
    fn broken(&self, cause: impl std::fmt::Display) -> Error {
        format!("{}: {cause}", self.name).into()
    }

    /// The next line of its output that is one of JSON; other lines are its libraries' own.
    fn answer<T: DeserializeOwned>(&mut self) -> Result<T, Error> {
        loop {
            let mut line = String::new();
            let read = self.answers.read_line(&mut line);
            if read.map_err(|e| self.broken(e))? == 0 {
                return Err(self.broken("it ended before it answered; its own output says why"));
            }
            if line.starts_with('{') {
                return serde_json::from_str(&line).map_err(|e| self.broken(e));
            }
        }
    }

    fn ask<T: DeserializeOwned>(&mut self, command: &str) -> Result<T, Error> {
        writeln!(self.commands, "{command}").map_err(|e| self.broken(e))?;
        self.answer()
    }
}

impl Timed for Peer {
    fn slice(&mut self) -> Result<Sample, Error> {
        let Took { wall_s, cpu_s } = self.ask(&format!("steps {STEPS}"))?;
        Ok(Sample { updates: STEPS * self.particles, wall_s, cpu_s })
    }

    fn outcome(&mut self) -> Result<Option<Outcome>, Error> {
        let sums: BTreeMap<String, f64> = self.ask("sums")?;
        Ok(Some(Outcome { bits: None, sums }))
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn peers(folder: &Path, script: &str) -> Peers {
        let file = folder.join("peer.sh");
        std::fs::write(&file, script).unwrap();
        Peers { python: PathBuf::from("sh"), script: file }
    }

    fn start(peers: &Peers) -> Result<Peer, Error> {
        peers.start("a peer", standard::<2>(REMEDIES[1]), true, 1)
    }

    #[test]
    fn a_peer_answers_what_it_is_asked() {
        let folder = tempfile::tempdir().unwrap();
        let script = r#"
            [ "$*" = "--dimension 2 --cells 240 --threads 1 --fbar --tuned" ] || exit 1
            echo "a library says hello"
            echo '{"ready": "1.0"}'
            while read -r command; do
                case $command in
                    "steps 10") echo '{"wall_s": 1.5, "cpu_s": 2.5}' ;;
                    sums) echo '{"mass": 3.0}' ;;
                esac
            done
        "#;
        let mut peer = start(&peers(folder.path(), script)).unwrap();
        let sample = peer.slice().unwrap();
        assert_eq!((sample.wall_s, sample.cpu_s), (1.5, 2.5));
        assert_eq!(sample.updates, 10 * 230_400);
        let sums = peer.outcome().unwrap().unwrap().sums;
        assert_eq!(sums, [("mass".to_owned(), 3.0)].into());
    }

    #[test]
    fn a_peer_that_is_not_to_be_had_says_what_it_needs() {
        let folder = tempfile::tempdir().unwrap();
        let error = |peers: &Peers| start(peers).err().unwrap().to_string();
        let ends = error(&peers(folder.path(), "exit 1"));
        assert!(ends.contains("a peer: it ended before it answered"), "{ends}");
        let mut none = peers(folder.path(), "");
        none.python = folder.path().join("no-python");
        assert!(error(&none).contains("requirements.txt"));
        none.script = folder.path().join("no-script");
        assert!(error(&none).contains("no-script"));
    }
}
