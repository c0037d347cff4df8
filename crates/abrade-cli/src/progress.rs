//! How far work is: a bar with the time left on a terminal, a plain line now and then in a pipe.

use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use abrade_report::quantity_text::{count, time};
use abrade_scene::Progress;
use indicatif::{ProgressBar, ProgressStyle};

use crate::say;

/// Parts of a run that the bar can show.
const PARTS: u64 = 1000;
/// Time between two lines in a pipe.
const SILENCE: Duration = Duration::from_secs(10);

/// What is shown, and whether an interrupt was asked for.
pub(crate) struct Bar<'a> {
    shown: Shown,
    /// Cases that are over, of how many; of one run, nothing.
    cases: Option<[usize; 2]>,
    shows_time: bool,
    stop: &'a AtomicBool,
}

enum Shown {
    Bar(ProgressBar),
    Lines { began: Instant, lines: Lines },
}

impl<'a> Bar<'a> {
    /// Of one run.
    pub(crate) fn new(stop: &'a AtomicBool) -> Self {
        Self { shows_time: true, ..Self::of_cases(stop) }
    }

    /// Of many cases, whose simulated time tells nobody anything.
    pub(crate) fn of_cases(stop: &'a AtomicBool) -> Self {
        let shown = match std::io::stderr().is_terminal() {
            true => {
                let bar = ProgressBar::no_length();
                bar.set_style(ProgressStyle::default_spinner());
                bar.enable_steady_tick(Duration::from_millis(200));
                Shown::Bar(bar)
            }
            false => Shown::Lines { began: Instant::now(), lines: Lines::default() },
        };
        Self { shown, cases: None, shows_time: false, stop }
    }

    /// Takes the bar off the terminal.
    pub(crate) fn clear(&self) {
        if let Shown::Bar(bar) = &self.shown {
            bar.finish_and_clear();
        }
    }
}

impl Progress for Bar<'_> {
    fn advance(&mut self, simulated: f64, share: Option<f64>) -> bool {
        let share = share.map(|share| share.clamp(0.0, 1.0));
        let doing = match self.cases {
            Some([over, all]) => format!("{over} of {}", count(all, "case", "cases")),
            None if self.shows_time => format!("{simulated:.3e} s simulated"),
            None => String::new(),
        };
        match &mut self.shown {
            Shown::Bar(bar) => show(bar, share, doing),
            Shown::Lines { began, lines } => {
                if let Some(line) = lines.next(began.elapsed(), share, &doing) {
                    say::aside(&line);
                }
            }
        }
        !self.stop.load(Ordering::Relaxed)
    }

    fn cases(&mut self, over: usize, all: usize) {
        self.cases = Some([over, all]);
    }
}

fn show(bar: &ProgressBar, share: Option<f64>, mut doing: String) {
    let is_first = share.is_some() && bar.length().is_none();
    if let Some(share) = share {
        if is_first {
            bar.set_length(PARTS);
            let style = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}{eta} left");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        }
        bar.set_position((share * PARTS as f64) as u64);
        if !doing.is_empty() {
            doing += ", ";
        }
    }
    bar.set_message(doing);
    if is_first {
        // What an earlier call has made took no time now. The message takes the place into the estimate.
        bar.reset_eta();
    }
}

/// The lines of a pipe.
#[derive(Debug, Default)]
struct Lines {
    /// Share that was done, and when, at the first call: what an earlier command has made took no time now.
    first: Option<(f64, Duration)>,
    /// When the last line was told.
    told: Duration,
}

impl Lines {
    /// The line that is due at `now`, since the work began.
    fn next(&mut self, now: Duration, share: Option<f64>, doing: &str) -> Option<String> {
        let first = share.map(|share| *self.first.get_or_insert((share, now)));
        if now < self.told + SILENCE {
            return None;
        }
        self.told = now;
        let mut parts = vec![format!("after {}", time(now.as_secs_f64().round()))];
        parts.extend(share.map(|share| format!("{:.0} %", 100.0 * share)));
        parts.extend((!doing.is_empty()).then(|| doing.to_owned()));
        let left = share.zip(first).and_then(|(share, (before, began))| {
            let rate = (share - before) / (now - began).as_secs_f64();
            (rate > 0.0).then(|| (1.0 - share) / rate)
        });
        let left = left.map(f64::round).filter(|left| *left > 0.0);
        parts.extend(left.map(|left| format!("about {} left", time(left))));
        Some(parts.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a pipe that gets a line with every step, and for a time left that takes what an earlier
    /// command has made for work of this one.
    #[test]
    fn a_pipe_is_told_how_far_the_work_is_now_and_then() {
        let mut lines = Lines::default();
        let mut at = |seconds: f64, share: f64| {
            lines.next(Duration::from_secs_f64(seconds), Some(share), "5 of 10 cases")
        };
        assert_eq!(at(0.0, 0.5), None);
        assert_eq!(at(9.9, 0.6), None);
        let told = at(20.0, 0.75).expect("a line");
        assert_eq!(told, "after 20 s, 75 %, 5 of 10 cases, about 20 s left");
        assert_eq!(at(29.9, 0.8), None);
        assert!(at(30.0, 0.8).is_some());
        assert_eq!(at(40.0, 1.0).as_deref(), Some("after 40 s, 100 %, 5 of 10 cases"));
    }

    /// Fails for a run whose end nobody knows that stays silent, or tells an end.
    #[test]
    fn a_run_without_a_known_end_tells_what_it_has_done() {
        let told = Lines::default().next(Duration::from_secs(90), None, "1e-3 s simulated");
        assert_eq!(told.as_deref(), Some("after 1.5 min, 1e-3 s simulated"));
    }
}
