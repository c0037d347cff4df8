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

    fn sync(&mut self) -> ColliderHandle {
        self.wear.sync_collider(self.plate, &mut self.world.colliders).expect("a proxy")
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

    fn shape_seen(&self, collider: ColliderHandle) -> *const () {
        std::ptr::from_ref(self.world.colliders[collider].shape()).cast()
    }
}

/// Fails for a field that is turned, shifted by a row or by half a pitch, or scaled, at any place
/// of a proxy that is tilted; and for one that a proxy's top hides from its own groups.
#[test]
fn a_ray_meets_every_node_where_it_is() {
    let mut rig = Rig::struck();
    let tilt = Isometry3::new(Vector3::new(0.1, 0.2, -0.3), Vector3::new(0.4, -0.7, 1.9));
    rig.world.colliders[rig.proxy].set_position(scalar::to_pose(&tilt));
    let shown = rig.sync();
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
    let proxy = QueryFilter::default().exclude_collider(shown);
    assert!(rig.look_down(at, proxy).expect("the proxy").abs() < rounding, "the proxy's own top");
}

/// Fails for a query collider that bears, obstructs or is in a pair: a collider is in every group by default.
#[test]
fn nothing_collides_with_it() {
    let run = |with: bool| {
        let mut rig = Rig::struck();
        let shown = with.then(|| rig.sync());
        let at = Vector3::new(0.255, -0.5, 0.125 + RADIUS + GAP);
        let ball = rig.ball(at, towards_plate(20.0, 60.0));
        rig.world.gravity = scalar::to_vector(&Vector3::new(0.0, 0.0, -9.81));
        for _ in 0..60 {
            rig.step();
            let pairs = shown.map_or(0, |shown| rig.world.contact_pairs_with(shown).count());
            assert_eq!(pairs, 0);
        }
        (rig.wear[rig.plate].wear_volume(), rig.state(ball), *rig.wear.counters())
    };
    let (alone, shown) = (run(false), run(true));
    assert_eq!(alone, shown);
}

/// Fails for a field that is made at every call, or that stays as it was made.
#[test]
fn it_is_made_anew_only_when_something_has_worn() {
    let mut rig = Rig::new(Vector3::zeros(), DT);
    let shown = rig.sync();
    let fresh = rig.shape_seen(shown);
    rig.step();
    assert_eq!((rig.sync(), rig.shape_seen(shown)), (shown, fresh));
    rig.ball(Vector3::z() * (RADIUS + GAP), towards_plate(60.0, 90.0));
    rig.step();
    assert_eq!(rig.shape_seen(shown), fresh, "on demand only");
    assert_eq!(rig.sync(), shown);
    assert_ne!(rig.shape_seen(shown), fresh);
    let low = scalar::wide(rig.world.colliders[shown].compute_aabb().mins.z);
    let deepest = rig.wear[rig.plate].worn().max_depth;
    assert!((low + deepest).abs() < scalar::ROUNDING, "{low} m, {deepest} m");
}

/// Fails for a collider that is not looked for before it is used, and for one of a proxy that is
/// gone.
#[test]
fn it_comes_back_when_it_was_removed() {
    let mut rig = Rig::struck();
    let shown = rig.sync();
    rig.world.remove_collider(shown);
    let again = rig.sync();
    assert!(rig.world.colliders.contains(again) && again != shown);
    rig.world.remove_collider(rig.proxy);
    assert!(rig.wear.sync_collider(rig.plate, &mut rig.world.colliders).is_err());
}
