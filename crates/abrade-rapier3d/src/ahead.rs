//! Running the bodies of a step ahead of their turns: each as if it were alone, on leaves of the
//! surfaces, on as many threads as there are.
//!
//! Then every body gets its turn, in the order of the handles (`resolve`). What it did ahead
//! holds, to the bit, if it would do the same now: nobody before it has changed a node that it
//! read, and nobody is where it was. Else it is run again. So no result depends on threads.

use abrade::{Advance, Changes, Encounter, PhysicsError, State, Surface, Until};
use nalgebra::Point3;
use rapier::dynamics::RigidBodyHandle;
use rayon::prelude::*;

use crate::changed::Changed;
use crate::micro::{self, Errand};
use crate::observer::Relay;
use crate::start::{Scene, Start};
use crate::surface::{SurfaceId, WornCollider};
use crate::track::{Trace, Track};
use crate::tracked::{Known, Tracked};
use crate::view::WorldView;
use crate::world::WearWorld;

/// Bodies that one thread takes at once, at most.
const BATCH: usize = 8;

/// What a body did as if it were alone.
pub(crate) struct Ahead {
    pub end: State,
    pub encounter: Encounter,
    pub surfaces: Vec<SurfaceId>,
    pub advance: Advance,
    /// Where the body was, in the frame of its first surface.
    pub track: Track,
    pub changes: Vec<Changes>,
    /// Per surface, the undeformed box in which it read depths.
    reads: Vec<Option<[Point3<f64>; 2]>>,
}

impl Ahead {
    /// Runs a body over the whole of a step of `dt` [s], from its `start`.
    pub fn run(
        start: &Start,
        mut encounter: Encounter,
        tracked: &Tracked,
        scene: &Scene<'_>,
        errand: &Errand<'_>,
    ) -> Result<Self, PhysicsError> {
        let Known::Ready(body) = &tracked.known else {
            return Err(PhysicsError::Unsupported { what: "the body was not derived" });
        };
        let mut body = body.as_ref().clone();
        body.state = start.state;
        let ids = &start.surfaces;
        let leaf = |id: &SurfaceId| Surface::leaf(&scene.surfaces[id.0].surface);
        let mut leaves: Vec<Surface> = ids.iter().map(leaf).collect();
        let seats = micro::seats(ids, scene.lies, &start.frame);
        let mut placed = micro::placed(leaves.iter_mut(), &seats);
        let trace = Trace::new(start.state.position, errand.pull(&body), scene.dt);
        let (observer, frame) = (&mut (), start.frame);
        let mut relay =
            Relay { observer, body: tracked.handle, frame, surfaces: ids, began: 0.0, trace };
        encounter.take_reads().for_each(drop);
        let (loads, until) = (&errand.loads, errand.until);
        let advance =
            encounter.advance(&mut body, &mut placed, loads, errand.dt, until, &mut relay)?;
        let track = relay.trace.finish().map(|e| e.grown(start.course.radius()));
        let reads = encounter.take_reads().collect();
        let changes = leaves.into_iter().map(Surface::into_changes).collect();
        let (end, surfaces) = (body.state, ids.clone());
        Ok(Self { end, encounter, surfaces, advance, track, changes, reads })
    }

    /// True when nobody has changed a node that it read.
    pub fn holds(&self, changed: &Changed, surfaces: &[WornCollider]) -> bool {
        let mut reads = self.surfaces.iter().zip(&self.reads);
        reads.all(|(id, read)| read.is_none_or(|r| changed.spares(id.0, &surfaces[id.0], r)))
    }
}

impl WearWorld {
    /// Runs the candidates of the step ahead.
    pub(crate) fn run_ahead(&mut self, world: &WorldView<'_>) {
        self.surfaces.iter_mut().for_each(|worn| worn.broken = false);
        self.changed.note(&self.surfaces, self.candidates.len());
        let slot = |handle: &RigidBodyHandle| handle.into_raw_parts().0 as usize;
        let indices: Vec<usize> = self.candidates.iter().map(slot).collect();
        let mut all: Vec<_> = indices.iter().map(|&index| self.bodies[index].take()).collect();
        let scene = self.scene(world);
        all.par_iter_mut().with_max_len(BATCH).flatten().for_each(|tracked| {
            tracked.ahead = run(tracked, &scene).map(Box::new);
        });
        for (index, tracked) in indices.into_iter().zip(all) {
            self.bodies[index] = tracked;
        }
    }
}

/// What a body does if it is alone; nothing if it will not be let through, or if it fails.
fn run(tracked: &mut Tracked, scene: &Scene<'_>) -> Option<Ahead> {
    let start = scene.start(tracked).ok()??;
    if start.free.is_some() || start.skin.is_some() {
        // Whoever comes first moves the surface of those who follow, or wears two.
        return None;
    }
    let way = start.way(scene.world, scene.obstacles)?;
    let encounter = scene.encounter(&start, tracked).ok()?;
    let errand = scene.errand(way, &start, Until::Duration);
    Ahead::run(&start, encounter, tracked, scene, &errand).ok()
}
