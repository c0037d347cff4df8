use abrade_lockstep::rapier::prelude::*;
fn main() {
    for dt in [1.0 / 60.0, 1.0 / 240.0, 1e-3] {
        let mut w = PhysicsWorld::default();
        w.gravity = Vector::new(0.0, 0.0, -9.81);
        w.integration_parameters.dt = dt;
        let s = w.colliders.insert(
            ColliderBuilder::cuboid(0.1, 0.1, 0.01).translation(Vector::new(0.0, 0.0, -0.01)),
        );
        let (b, c) = w.insert(
            RigidBodyBuilder::dynamic().translation(Vector::new(0.0, 0.0, 0.003)).can_sleep(false),
            ColliderBuilder::ball(0.003).density(2500.0),
        );
        let m = w.bodies[b].mass();
        w.bodies[b].set_linvel(Vector::new(0.1, 0.0, 0.0), true);
        for i in 0..200 {
            let v0 = w.bodies[b].linvel();
            w.step();
            if i % 20 == 0 || i < 4 {
                let v = w.bodies[b].linvel();
                if let Some(p) = w.narrow_phase.contact_pair(s, c) {
                    let man = &p.solver_manifolds();
                    let t: Vec<_> = man
                        .iter()
                        .flat_map(|m| {
                            m.points
                                .iter()
                                .map(|p| (p.data.impulse, p.data.tangent_impulse, p.dist))
                        })
                        .collect();
                    println!(
                        "dt {dt:.4} i {i} J/(m g dt) {:?} z {:.3e} dv {:.2e} vx {:.3e} {:?}",
                        p.total_impulse().length() / (m * 9.81 * dt),
                        w.bodies[b].translation().z - 0.003,
                        (v - v0).z,
                        v.x,
                        t.len()
                    );
                }
            }
        }
    }
}
