//! The springs of one of two worn surfaces: its nodes against the facets of the other.

use nalgebra::{Isometry3, Point3};

use super::{Patch, yield_overlap};
use crate::body::State;
use crate::candidates::Slot;
use crate::elastic::coefficient_of_two;
use crate::mesh_query::MeshQuery;
use crate::node_law::{STEEP, Spring};
use crate::query::{BodyQuery, Query};
use crate::surface::Surface;

/// Corrections that bring a node to a wanted overlap.
const HOLDS: usize = 4;

impl Patch {
    /// The nodes of `surface` against the facets of `other`, whose frame is at `offset` in that of
    /// the striker; they take a `share` of every drop.
    pub(crate) fn of_two(
        surface: &Surface,
        other: &Surface,
        offset: Isometry3<f64>,
        share: f64,
        keeps_ledger: bool,
    ) -> Self {
        let coefficient = coefficient_of_two(surface, other);
        let query = BodyQuery::Mesh(Box::new(MeshQuery::new(offset, coefficient)));
        let yield_overlap = yield_overlap([coefficient].into_iter(), surface);
        let own = if share < 1.0 { 0.5 } else { 1.0 };
        Self { share, own, ..Self::with_query(query, 0.0, yield_overlap, surface, keeps_ledger) }
    }

    /// Takes the corners of `facets` of `surface` that are `near` for candidates, against the facets
    /// of `other` that have the corners `strikers`, found within `reach` [m]. In a contact that goes
    /// on with the striker in a state, what both have worn comes to light; no spring feels that, and
    /// no other node is touched by it.
    pub(crate) fn meet(
        &mut self,
        [surface, other]: [&Surface; 2],
        [facets, strikers]: [&[[u32; 3]]; 2],
        near: impl Fn(&Point3<f64>) -> bool,
        reach: f64,
        going_on: Option<&State>,
    ) {
        self.collect(&surface.laws, |candidates| {
            candidates.collect_corners(surface, facets, near);
        });
        let BodyQuery::Mesh(query) = &mut self.query else { return };
        query.set(strikers, other, reach);
        if let Some(state) = going_on {
            query.place(state);
            hold(query, &mut self.candidates.slots, &self.old);
        }
    }

    /// Lets the corners of the facets that nodes of an equal lean on sink by their part of the last
    /// trial's drops: as much volume as the nodes themselves.
    pub(crate) fn hand_over(&self, other: &mut Surface) {
        let BodyQuery::Mesh(query) = &self.query else { return };
        for (slot, spring) in self.candidates.slots.iter().zip(&self.new) {
            let Spring { drop, .. } = *spring;
            let part = self.share * self.own * slot.area;
            if spring.overlap <= 0.0 || drop.normal + drop.lateral <= 0.0 {
                continue;
            }
            let Some((corners, weights)) = query.seat(&slot.x) else { continue };
            let debris = other.laws.removal.debris(|| self.attack(slot));
            for (corner, weight) in corners.into_iter().zip(weights) {
                let area = other.nodes().rest_area[corner as usize];
                let [normal, lateral] = [drop.normal, drop.lateral].map(|d| part * weight * d);
                let total = normal + lateral;
                other.sink(corner, total / area);
                other.gain.normal += normal;
                other.gain.lateral += lateral;
                other.gain.take_off(total, &debris);
            }
        }
    }
}

/// Moves the nodes to where pressed ones have the overlaps of their springs, and the others none.
fn hold(query: &MeshQuery, slots: &mut [Slot], springs: &[Spring]) {
    for (slot, spring) in slots.iter_mut().zip(springs) {
        for _ in 0..HOLDS {
            let touch = query.touch(&slot.x, &slot.n);
            let excess = touch.overlap - spring.overlap;
            let cosine = -touch.contact_normal.dot(&slot.n);
            if cosine <= STEEP || spring.overlap == 0.0 && excess <= 0.0 {
                break;
            }
            slot.x -= slot.n * (excess / cosine);
        }
    }
}
