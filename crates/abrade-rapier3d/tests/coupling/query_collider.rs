//! What rays see of a worn surface, and that nothing collides with it.

use super::rig::{GAP, RADIUS, Rig, towards_plate};
use crate::plugin::rapier::prelude::*;
use crate::plugin::{WearWorld, scalar};
use nalgebra::{Isometry3, Point3, Vector3};

const DT: f64 = 1.0 / 240.0;
/// Shares of a pitch by which a ray falls beside a node: one on an edge may slip between triangles.
const BESIDE: f64 = 0.01;

impl Rig {
    /// A plate with the crater of an oblique impact.
    fn struck() -> Self {
        let mut rig = Self::new(Vector3::new(0.25, -0.5, 0.125), DT);
        let origin = Vector3::new(0.25, -0.5, 0.125);
        rig.ball(origin + Vector3::z() * (RADIUS + GAP), towards_plate(60.0, 45.0));
        rig.step();
        assert!(rig.wear[rig.plate].wear_volume() > 0.0);
        rig
    }

    /// Number of query colliders made anew.
    fn sync(&mut self) -> usize {
        self.wear.sync_colliders(self.plate, &mut self.world.colliders).expect("a proxy")
    }

    fn shown(&self) -> Vec<ColliderHandle> {
        self.wear.query_colliders(self.plate).to_vec()
    }

    fn frame(&self) -> Isometry3<f64> {
        self.wear.frame(self.plate, &self.world.colliders).expect("a proxy")
    }

    /// Where a ray from 10 mm above `point_local` down along the plate's normal meets something of
    /// `filter` [m].
    fn look_down(&self, point_local: Point3<f64>, filter: QueryFilter<'_>) -> Option<f64> {
        let high = Point3::new(point_local.x, point_local.y, 0.01);
        let (frame, down) = (self.frame(), -Vector3::z());
        let from = scalar::to_vector(&(frame * high).coords);
        let ray = Ray::new(from, scalar::to_vector(&(frame * down)));
        let hit = self.world.cast_ray(&ray, scalar::narrow(0.1), true, filter);
        hit.map(|(_, way)| high.z - scalar::wide(way))
    }

    fn shapes_seen(&self) -> Vec<*const ()> {
        let shape = |handle: &ColliderHandle| self.world.colliders[*handle].shape();
        self.shown().iter().map(|handle| std::ptr::from_ref(shape(handle)).cast()).collect()
    }
}

/// Fails for a field that is turned, shifted by a row or by half a pitch, or scaled, at any place
/// of a proxy that is tilted; and for one that a proxy's top hides from its own groups.
#[test]
fn a_ray_meets_every_node_where_it_is() {
    let mut rig = Rig::struck();
    let tilt = Isometry3::new(Vector3::new(0.1, 0.2, -0.3), Vector3::new(0.4, -0.7, 1.9));
    rig.world.colliders[rig.proxy].set_position(scalar::to_pose(&tilt));
    rig.sync();
    rig.step();
    let nodes = rig.wear[rig.plate].nodes();
    let [_, rows] = rig.wear[rig.plate].columns_rows().expect("a strip");
    let shift = Vector3::new(1.0, 1.0, 0.0) * BESIDE * rig.wear[rig.plate].pitch();
    // Poses and rays are rounded.
    let rounding = 16.0 * scalar::ROUNDING;
    let mut worn = 0;
    for i in 0..nodes.len() {
        let at = nodes.rest_position[i];
        let inside = at.x.abs() < 14e-3 && at.y.abs() < 5.5e-3;
        if !inside || nodes.depth[i] == 0.0 && i % 97 != 0 {
            continue;
        }
        worn += usize::from(nodes.depth[i] > 0.0);
        let depth = nodes.depth[i];
        let near = [i - 1, i + 1, i - rows - 1, i - rows, i - rows + 1].into_iter();
        let near = near.chain([i + rows - 1, i + rows, i + rows + 1]);
        let steepest = near.map(|j| (nodes.depth[j] - depth).abs()).fold(0.0, f64::max);
        let seen = rig.look_down(at + shift, WearWorld::WORN_ONLY.into()).expect("the surface");
        let slack = 3.0 * BESIDE * steepest + rounding;
        assert!((seen + depth).abs() < slack, "node {i}: {seen} m, {depth} m, {slack} m");
    }
    assert!(worn > 50, "{worn} worn nodes");
    let other = QueryFilter::default().exclude_collider(rig.proxy);
    let lowest = (0..nodes.len()).max_by(|&a, &b| nodes.depth[a].total_cmp(&nodes.depth[b]));
    let at = nodes.rest_position[lowest.expect("a node")] + shift;
    assert_eq!(rig.look_down(at, other), rig.look_down(at, WearWorld::WORN_ONLY.into()));
    let shown = rig.shown();
    let is_other = |handle, _: &Collider| !shown.contains(&handle);
    let proxy = QueryFilter::default().predicate(&is_other);
    assert!(rig.look_down(at, proxy).expect("the proxy").abs() < rounding, "the proxy's own top");
}

/// Fails for a query collider that bears, obstructs or is in a pair: a collider is in every group by default.
#[test]
fn nothing_collides_with_it() {
    let run = |with: bool| {
        let mut rig = Rig::struck();
        if with {
            rig.sync();
        }
        let at = Vector3::new(0.255, -0.5, 0.125 + RADIUS + GAP);
        let ball = rig.ball(at, towards_plate(20.0, 60.0));
        rig.world.gravity = scalar::to_vector(&Vector3::new(0.0, 0.0, -9.81));
        for _ in 0..60 {
            rig.step();
            let pairs = |shown: &ColliderHandle| rig.world.contact_pairs_with(*shown).count();
            assert!(rig.shown().iter().all(|shown| pairs(shown) == 0));
        }
        (rig.wear[rig.plate].wear_volume(), rig.state(ball), *rig.wear.counters())
    };
    let (alone, shown) = (run(false), run(true));
    assert_eq!(alone, shown);
}

/// Fails for fields that are made at every call, or that stay as they were made.
#[test]
fn they_are_made_anew_only_when_something_has_worn() {
    let mut rig = Rig::new(Vector3::zeros(), DT);
    let tiles = rig.sync();
    let (shown, fresh) = (rig.shown(), rig.shapes_seen());
    assert_eq!(tiles, shown.len());
    rig.step();
    assert_eq!((rig.sync(), rig.shown(), rig.shapes_seen()), (0, shown.clone(), fresh.clone()));
    rig.ball(Vector3::z() * (RADIUS + GAP), towards_plate(60.0, 90.0));
    rig.step();
    assert_eq!(rig.shapes_seen(), fresh, "on demand only");
    let made = rig.sync();
    let differ = rig.shapes_seen().iter().zip(&fresh).filter(|(a, b)| a != b).count();
    assert!(made > 0 && made == differ && rig.shown() == shown, "{made} made, {differ} differ");
    let low =
        |handle: &ColliderHandle| scalar::wide(rig.world.colliders[*handle].compute_aabb().mins.z);
    let low = shown.iter().map(low).fold(0.0, f64::min);
    let deepest = rig.wear[rig.plate].worn().max_depth;
    assert!((low + deepest).abs() < scalar::ROUNDING, "{low} m, {deepest} m");
}

/// Fails for colliders that are not looked for before they are used, and for those of a proxy that
/// is gone.
#[test]
fn they_come_back_when_they_were_removed() {
    let mut rig = Rig::struck();
    rig.sync();
    for place in [0, 7] {
        let before = rig.shown();
        rig.world.remove_collider(before[place]);
        assert_eq!(rig.sync(), 1);
        let again = rig.shown();
        let differ: Vec<usize> = (0..again.len()).filter(|i| again[*i] != before[*i]).collect();
        assert_eq!(differ, [place]);
        assert!(rig.world.colliders.contains(again[place]));
    }
    rig.world.remove_collider(rig.proxy);
    assert!(rig.wear.sync_colliders(rig.plate, &mut rig.world.colliders).is_err());
}
