//! Checks of hardness by place: maps, and regions with nodes in them.

use std::collections::BTreeMap;
use std::path::Path;

use abrade::{ParameterError, TriangleMesh};
use nalgebra::Point3;

use super::{Checker, finite};
use crate::hardness::{self, Places};
use crate::place;
use crate::scene::{HardnessMap, Region, SceneSurface};
use crate::spans::ScenePath;

/// What its file is called in messages.
const MAP: &str = "hardness map";

impl Checker<'_> {
    /// Checks the hardness maps and the regions of every surface whose nodes are known: a refused
    /// geometry has none. Returns the hardness of every node over that of the material, of the
    /// surfaces that have any of them.
    pub(super) fn check_hardnesses(
        &mut self,
        folder: &Path,
        meshes: &BTreeMap<String, TriangleMesh>,
    ) -> BTreeMap<String, Vec<f32>> {
        let mut found = BTreeMap::new();
        for (name, surface) in &self.scene.surfaces {
            if surface.hardness_map.is_none() && surface.regions.is_empty() {
                continue;
            }
            let nodes = match (meshes.get(name), place::strip(&surface.geometry)) {
                (Some(mesh), _) => mesh.vertices().to_vec(),
                (None, Some(strip)) => strip.positions(),
                (None, None) => Vec::new(),
            };
            let path = ScenePath::of(["surfaces", name]);
            let factors = self.check_hardness(&path, surface, &nodes, folder);
            found.extend(factors.map(|factors| (name.clone(), factors)));
        }
        found
    }

    /// Checks the map and the regions of the surface at `path`, whose nodes are `nodes`.
    fn check_hardness(
        &mut self,
        path: &ScenePath,
        surface: &SceneSurface,
        nodes: &[Point3<f64>],
        folder: &Path,
    ) -> Option<Vec<f32>> {
        let of_material = self.scene.materials.get(&surface.material)?.hardness;
        let mut hardness = vec![of_material; nodes.len()];
        if let Some(map) = &surface.hardness_map {
            let places = self.places(&path.join("hardness_map"), map, of_material, folder)?;
            for (node, hardness) in nodes.iter().zip(&mut hardness) {
                *hardness = places.hardness(node).unwrap_or(*hardness);
            }
        }
        for (number, region) in surface.regions.iter().enumerate() {
            let path = path.join("regions").join(number.to_string());
            if !self.check_region(&path, region, of_material) || nodes.is_empty() {
                continue;
            }
            let inside: Vec<usize> = hardness::inside(&region.extent, nodes).collect();
            if inside.is_empty() {
                self.refuse(&path, format!("`{path}` has no node in its box"), reach(nodes));
            }
            inside.into_iter().for_each(|i| hardness[i] = region.hardness);
        }
        Some(hardness.into_iter().map(|hardness| (hardness / of_material) as f32).collect())
    }

    /// The places of a map; None when it is refused.
    fn places(
        &mut self,
        path: &ScenePath,
        map: &HardnessMap,
        of_material: f64,
        folder: &Path,
    ) -> Option<Places> {
        let wrong_scale = ParameterError::positive("scale", map.scale);
        let is_wrong = wrong_scale.is_some();
        self.ranges(path, [wrong_scale]);
        let path = path.join("file");
        let rows = self.read_rows(&path, MAP, folder, &map.file)?;
        match Places::of(&rows, map.scale, of_material) {
            Ok(places) if places.is_empty() => {
                let message = format!("the hardness map `{}` has no line", map.file);
                self.refuse(&path, message, "");
                None
            }
            Ok(places) => (!is_wrong).then_some(places),
            Err((line, fault)) => {
                self.refuse_row(&path, MAP, line, fault);
                None
            }
        }
    }

    /// True when the numbers of a region are fine.
    fn check_region(&mut self, path: &ScenePath, region: &Region, of_material: f64) -> bool {
        let before = self.problems.len();
        self.ranges(path, [hardness::check(region.hardness, of_material)]);
        let (path, extent) = (path.join("box"), &region.extent);
        for (field, corner) in [("from", &extent.from), ("to", &extent.to)] {
            let bad = corner.iter().find(|x| !x.is_finite());
            self.ranges(&path, [bad.map(|&x| finite(field, x))]);
        }
        if let Some(axis) = (0..3).find(|&axis| extent.from[axis] > extent.to[axis]) {
            let axis_name = ["x", "y", "z"][axis];
            let message = format!("`{path}` is empty along {axis_name}");
            let label = format!("is below `from`, which is {} m", extent.from[axis]);
            self.refuse(&path.join("to").join(axis.to_string()), message, label);
        }
        self.problems.len() == before
    }
}

/// Where the nodes are.
fn reach(nodes: &[Point3<f64>]) -> String {
    let [low, high] = nodes.iter().fold([nodes[0]; 2], |[low, high], p| [low.inf(p), high.sup(p)]);
    let corner = |p: Point3<f64>| format!("({:.3e}, {:.3e}, {:.3e})", p.x, p.y, p.z);
    format!("the nodes are between {} and {} m", corner(low), corner(high))
}
