//! ParaView series `elements` and `links`, and the picture of some of their instants.

use std::path::{Path, PathBuf};

use abrade_adhesive::{Collision, LinkState};
use abrade_report::{Instant, ReportError, Rounds, Series, atomic, vtp};

use super::file::SceneFile;
use super::series::passed;

/// File of the picture, in the folder of a run.
pub const PICTURE: &str = "asperities.png";
/// Instants of the picture, as shares of the travel.
const SHOWN: [f64; 3] = [0.25, 0.5, 1.0];

/// The files as they grow.
pub(crate) struct Frames {
    folder: PathBuf,
    title: String,
    caption: String,
    diameter: f64,
    period: f64,
    count: u32,
    seen: u32,
    elements: Series,
    links: Series,
    instants: Vec<Instant>,
}

impl Frames {
    pub(crate) fn new(file: &SceneFile, folder: &Path) -> Self {
        let solid = &file.solid;
        let mega = |stress: f64| abrade_report::quantity_text::pressure(stress);
        Self {
            folder: folder.to_owned(),
            title: file.name.clone(),
            caption: format!(
                "a = {}, sigma_j = {}, sigma_0 = {}, overlap {}",
                solid.strength_ratio,
                mega(solid.shear_strength),
                mega(solid.adhesion),
                file.bodies.overlap
            ),
            diameter: file.bodies.diameter,
            period: file.bodies.whole_period(),
            count: file.frames,
            seen: 0,
            elements: Series::new(folder, "elements"),
            links: Series::new(folder, "links"),
            instants: Vec::new(),
        }
    }

    /// Share of the travel at which the next instant is due.
    pub(crate) fn next(&self) -> f64 {
        let picture = SHOWN.get(self.instants.len()).copied().unwrap_or(1.0);
        picture.min(f64::from(self.seen) / f64::from(self.count))
    }

    /// Writes an instant if one is due, or several: it stands once.
    pub(crate) fn see(&mut self, collision: &Collision) -> Result<(), ReportError> {
        let share = collision.share();
        if share >= f64::from(self.seen) / f64::from(self.count) {
            self.seen = passed(share, self.count).max(self.seen + 1);
            self.write(collision)?;
        }
        if SHOWN.get(self.instants.len()).is_some_and(|shown| share >= *shown) {
            self.instants.push(self.instant(collision));
        }
        Ok(())
    }

    /// Adds the end and writes the picture.
    pub(crate) fn finish(&mut self, collision: &Collision) -> Result<(), ReportError> {
        self.write(collision)?;
        let end = self.instant(collision);
        self.instants.push(end);
        let heights = (0..collision.parts().len()).map(|at| collision.simulation().position(at)[1]);
        let [low, high] =
            heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], y| [l.min(y), h.max(y)]);
        let rounds = Rounds {
            title: &self.title,
            caption: &self.caption,
            quantity: "equivalent plastic strain",
            diameter: self.diameter,
            window: [[0.0, low - self.diameter], [self.period, high + self.diameter]],
            instants: std::mem::take(&mut self.instants),
        };
        atomic::write(&self.folder.join(PICTURE), &rounds.to_png()?)
    }

    fn write(&mut self, collision: &Collision) -> Result<(), ReportError> {
        let simulation = collision.simulation();
        let all = 0..simulation.count();
        let points: Vec<[f64; 2]> = all.clone().map(|at| self.inside(collision, at)).collect();
        let of = |value: &dyn Fn(usize) -> f64| all.clone().map(value).collect::<Vec<f64>>();
        let stress = |k: usize| of(&|at| simulation.stress(at)[k]);
        let [xx, yy, xy, zz] = [0, 1, 2, 3].map(stress);
        let arrays: [vtp::PointArray; 9] = [
            ("plastic_strain", &of(&|at| simulation.plastic_strain(at))),
            ("stress_xx_Pa", &xx),
            ("stress_yy_Pa", &yy),
            ("stress_xy_Pa", &xy),
            ("stress_zz_Pa", &zz),
            ("equivalent_stress_Pa", &of(&|at| equivalent(simulation.stress(at)))),
            ("velocity_x_m_s", &of(&|at| simulation.velocity(at)[0])),
            ("velocity_y_m_s", &of(&|at| simulation.velocity(at)[1])),
            ("upper", &of(&|at| f64::from(u8::from(collision.parts()[at].is_upper)))),
        ];
        let time = simulation.time();
        vtp::write_plane(&self.elements.next_path(), &points, &arrays, false)?;
        self.elements.push(time);
        self.elements.write()?;
        self.write_links(collision, time)
    }

    fn write_links(&mut self, collision: &Collision, time: f64) -> Result<(), ReportError> {
        let (mut points, mut columns) = (Vec::new(), [const { Vec::new() }; 4]);
        for pair in collision.simulation().pairs().filter(|p| p.state == LinkState::Linked) {
            let Some(ends) = self.drawn(collision, pair.ends) else { continue };
            points.extend(ends);
            let made = f64::from(u8::from(!pair.is_original));
            let values = [pair.stress[0], pair.stress[1], f64::from(pair.breaks), made];
            for (column, value) in columns.iter_mut().zip(values) {
                column.extend([value; 2]);
            }
        }
        let [normal, tangential, failures, made] = &columns;
        let arrays: [vtp::PointArray; 4] = [
            ("normal_Pa", normal),
            ("tangential_Pa", tangential),
            ("failures", failures),
            ("made", made),
        ];
        vtp::write_plane(&self.links.next_path(), &points, &arrays, true)?;
        self.links.push(time);
        self.links.write()
    }

    fn instant(&self, collision: &Collision) -> Instant {
        let simulation = collision.simulation();
        let element = |at: usize| (self.inside(collision, at), simulation.plastic_strain(at));
        let linked = simulation.pairs().filter(|pair| pair.state == LinkState::Linked);
        Instant {
            name: format!("at {:.0} % of the travel", 100.0 * collision.share().min(1.0)),
            elements: (0..simulation.count()).map(element).collect(),
            links: linked
                .filter_map(|pair| Some((self.drawn(collision, pair.ends)?, !pair.is_original)))
                .collect(),
        }
    }

    /// Where an element is shown: in the first period.
    fn inside(&self, collision: &Collision, at: usize) -> [f64; 2] {
        let [x, y] = collision.simulation().position(at);
        [x.rem_euclid(self.period), y]
    }

    /// Where a link is shown; one over the end of the period is not.
    fn drawn(&self, collision: &Collision, ends: [u32; 2]) -> Option<[[f64; 2]; 2]> {
        let ends = ends.map(|end| self.inside(collision, end as usize));
        ((ends[0][0] - ends[1][0]).abs() < 0.5 * self.period).then_some(ends)
    }
}

/// Von Mises' stress [Pa].
fn equivalent([xx, yy, xy, zz]: [f64; 4]) -> f64 {
    let square = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
    (0.5 * square + 3.0 * xy * xy).sqrt()
}
