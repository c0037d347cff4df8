//! How far a run is: a bar with rate and time left on a terminal, nothing in a pipe.

use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use abrade_scene::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Parts of a run that the bar can show.
const PARTS: u64 = 1000;

/// The bar, and whether an interrupt was asked for.
pub(crate) struct Bar<'a> {
    bar: ProgressBar,
    shows_time: bool,
    stop: &'a AtomicBool,
}

impl<'a> Bar<'a> {
    /// Of one run.
    pub(crate) fn new(stop: &'a AtomicBool) -> Self {
        Self { shows_time: true, ..Self::of_cases(stop) }
    }

    /// Of many cases, whose simulated time tells nobody anything.
    pub(crate) fn of_cases(stop: &'a AtomicBool) -> Self {
        let target = match std::io::stderr().is_terminal() {
            true => ProgressDrawTarget::stderr(),
            false => ProgressDrawTarget::hidden(),
        };
        let bar = ProgressBar::with_draw_target(None, target);
        bar.set_style(ProgressStyle::default_spinner());
        bar.enable_steady_tick(Duration::from_millis(200));
        Self { bar, shows_time: false, stop }
    }

    /// Takes the bar off the terminal.
    pub(crate) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

impl Progress for Bar<'_> {
    fn advance(&mut self, simulated: f64, share: Option<f64>) -> bool {
        if let Some(share) = share {
            if self.bar.length().is_none() {
                self.bar.set_length(PARTS);
                let style =
                    ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}{eta} left");
                self.bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            }
            self.bar.set_position((share.clamp(0.0, 1.0) * PARTS as f64) as u64);
        }
        if self.shows_time {
            self.bar.set_message(format!("{simulated:.3e} s simulated, "));
        }
        !self.stop.load(Ordering::Relaxed)
    }
}
