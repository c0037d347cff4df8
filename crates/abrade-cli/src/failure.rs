//! Why a command ended early, and its exit code.

use std::io::IsTerminal;

use abrade_scene::SceneError;

use crate::render;
use crate::say;

/// Exit code of work that the user broke off.
pub(crate) const INTERRUPTED: u8 = 130;

/// Why a command ended early.
pub(crate) enum Failure {
    /// The scene is wrong.
    Scene(SceneError),
    /// Something else that was given is wrong.
    Input(anyhow::Error),
    /// The work itself failed.
    Run(anyhow::Error),
    /// The user broke the work off.
    Interrupted(Rest),
}

/// What is left of work that was broken off.
#[derive(Clone, Copy)]
pub(crate) enum Rest {
    /// What was done until then; the same command begins anew.
    Figures,
    /// What the same command goes on from.
    Cases,
}

impl Failure {
    /// Exit code: 1 for work that failed, 2 for bad input, 130 for an interrupt.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::Run(_) => 1,
            Self::Scene(_) | Self::Input(_) => 2,
            Self::Interrupted(_) => INTERRUPTED,
        }
    }

    /// Says it on the standard error stream, in colour on a terminal.
    pub(crate) fn print(&self) {
        match self {
            Self::Scene(error) => {
                let text = render::scene_error(error, std::io::stderr().is_terminal());
                say::aside(text.trim_end_matches('\n'));
            }
            Self::Input(error) | Self::Run(error) => say::aside(&format!("error: {error:#}")),
            Self::Interrupted(Rest::Figures) => {
                say::aside(
                    "interrupted; what was done until then is kept, and begins anew if run again",
                );
            }
            Self::Interrupted(Rest::Cases) => {
                say::aside("interrupted; the same command goes on from here");
            }
        }
    }
}
