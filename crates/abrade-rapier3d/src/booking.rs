//! The open contact of a body, whichever resolver carries it: totals since it began, and the
//! events where it begins and ends.

use nalgebra::Vector3;
use rapier::dynamics::RigidBodyHandle;

use crate::event::WearEvent;
use crate::surface::SurfaceId;

/// What a step did to a body's contact.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Booking {
    /// Impulse on the body, in the world [N s].
    pub impulse: Vector3<f64>,
    /// Time in contact [s].
    pub contact_time: f64,
    /// It is in contact at the end of the step.
    pub touches: bool,
}

/// Totals of a contact.
#[derive(Default)]
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Contact {
    /// Impulse on the body, in the world [N s].
    impulse: Vector3<f64>,
    /// Time in contact [s].
    pub time: f64,
    /// The surfaces worn since it began, with the volume displaced [m3].
    surfaces: Vec<(SurfaceId, f64)>,
}

impl Contact {
    /// Adds what a step did, `worn` being the volume displaced on each surface [m3]; raises events
    /// where the contact begins or ends.
    pub fn book(
        open: &mut Option<Self>,
        body: RigidBodyHandle,
        booking: &Booking,
        worn: &[(SurfaceId, f64)],
        events: &mut Vec<WearEvent>,
    ) {
        let Booking { impulse, contact_time, touches } = booking;
        if open.is_none() && !touches && *contact_time == 0.0 {
            return;
        }
        let contact = open.get_or_insert_with(Self::default);
        contact.impulse += impulse;
        contact.time += contact_time;
        // A contact that wears nothing is one with the first surface.
        let elastic = contact.surfaces.is_empty() && worn.iter().all(|(_, volume)| *volume == 0.0);
        for (at, &(surface, volume)) in worn.iter().enumerate() {
            if volume == 0.0 && !(elastic && at == 0) {
                continue;
            }
            match contact.surfaces.iter_mut().find(|(id, _)| *id == surface) {
                Some((_, sum)) => *sum += volume,
                None => {
                    contact.surfaces.push((surface, volume));
                    events.push(WearEvent::Started { body, surface });
                }
            }
        }
        if !touches {
            Self::end(open, body, events);
        }
    }

    /// Adds what a step wore that has failed on its way: how long it touched, and how hard, is not
    /// known.
    pub fn book_failed(
        open: &mut Option<Self>,
        body: RigidBodyHandle,
        worn: &[(SurfaceId, f64)],
        events: &mut Vec<WearEvent>,
    ) {
        if worn.iter().any(|(_, volume)| *volume != 0.0) {
            let booking = Booking { touches: true, ..Booking::default() };
            Self::book(open, body, &booking, worn, events);
        }
    }

    /// Adds volumes that broke off as the open contact was ended [m3].
    pub fn add_broken(open: &mut Option<Self>, broken: &[(SurfaceId, f64)]) {
        let Some(contact) = open else { return };
        for (surface, sum) in &mut contact.surfaces {
            let own = broken.iter().filter(|(id, _)| id == surface);
            *sum += own.map(|(_, volume)| volume).sum::<f64>();
        }
    }

    /// Impulse on the body so far [N s], and time in contact [s].
    pub fn so_far(&self) -> (Vector3<f64>, f64) {
        (self.impulse, self.time)
    }

    /// Ends the open contact, if there is one.
    pub fn end(open: &mut Option<Self>, body: RigidBodyHandle, events: &mut Vec<WearEvent>) {
        let Some(Self { impulse, time: contact_time, surfaces }) = open.take() else { return };
        for (surface, volume) in surfaces {
            events.push(WearEvent::Ended { body, surface, impulse, volume, contact_time });
        }
    }
}

#[cfg(feature = "serde-serialize")]
impl Contact {
    /// The surfaces worn since it began.
    pub fn surfaces(&self) -> impl Iterator<Item = SurfaceId> {
        self.surfaces.iter().map(|(id, _)| *id)
    }
}
