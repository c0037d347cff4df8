//! Where on the circle of the drum the liner was struck, as the mill stands: a table and a picture.

use std::fmt::Write as _;
use std::path::Path;

use abrade::Surface;
use abrade_rapier3d::rapier::math::Vector;
use abrade_report::mesh_files;

/// Sectors of the circle.
const SECTORS: usize = 36;

/// Volume worn off the liner in every sector [m3], from the right side of the mill on, against the
/// clock.
#[derive(Default)]
pub struct Toe {
    volumes: Vec<f64>,
}

impl Toe {
    /// Books a blow of a ball at `place`.
    pub fn add(&mut self, place: Vector, volume: f64) {
        self.volumes.resize(SECTORS, 0.0);
        let turn = f64::from(place.y.atan2(place.x)).rem_euclid(std::f64::consts::TAU);
        let sector = (turn / std::f64::consts::TAU * SECTORS as f64) as usize;
        self.volumes[sector.min(SECTORS - 1)] += volume;
    }

    /// Middle of the sector that lost most [degrees].
    pub fn place(&self) -> f64 {
        let most = (0..self.volumes.len()).max_by(|&a, &b| {
            let [a, b] = [a, b].map(|at| self.volumes[at]);
            a.total_cmp(&b)
        });
        degrees(most.unwrap_or_default())
    }

    /// Writes the table, the picture and the worn liner into a folder.
    pub fn write(&self, folder: &Path, liner: &Surface) -> Result<(), Box<dyn std::error::Error>> {
        std::fs::create_dir_all(folder)?;
        let mut table = csv::Writer::from_path(folder.join("toe.csv"))?;
        table.write_record(["angle_deg", "volume_m3"])?;
        for (sector, volume) in self.volumes.iter().enumerate() {
            table.write_record([degrees(sector).to_string(), volume.to_string()])?;
        }
        table.flush()?;
        std::fs::write(folder.join("toe.svg"), self.picture()?)?;
        mesh_files::write_obj(&folder.join("liner.obj"), liner.nodes(), &liner.triangles())?;
        Ok(())
    }

    /// A wedge per sector, outside of the drum's circle, as long as its volume says.
    fn picture(&self) -> Result<String, std::fmt::Error> {
        let most = self.volumes.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let mut text = String::from(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-200 -200 400 420\" \
             font-family=\"sans-serif\" font-size=\"11\">\n\
             <rect x=\"-200\" y=\"-200\" width=\"400\" height=\"420\" fill=\"white\"/>\n",
        );
        for (sector, volume) in self.volumes.iter().enumerate() {
            let [from, to] = [sector, sector + 1].map(|at| degrees(at) - 180.0 / SECTORS as f64);
            let far = 100.0 + 80.0 * volume / most;
            let at = |radius: f64, turn: f64| {
                let (sin, cos) = turn.to_radians().sin_cos();
                format!("{:.1},{:.1}", radius * cos, -radius * sin)
            };
            let corners = [at(100.0, from), at(far, from), at(far, to), at(100.0, to)].join(" ");
            writeln!(text, "<polygon points=\"{corners}\" fill=\"#b3442c\"/>")?;
        }
        let caption = format!(
            "worn off the liner, as the mill stands; longest: {:.1} mm3 in {} degrees",
            1e9 * most,
            360 / SECTORS
        );
        writeln!(text, "<circle r=\"100\" fill=\"none\" stroke=\"black\" stroke-width=\"2\"/>")?;
        writeln!(text, "<path d=\"M 40 0 A 40 40 0 0 0 -40 0\" fill=\"none\" stroke=\"black\"/>")?;
        writeln!(text, "<path d=\"M -45 -8 L -40 0 L -33 -6\" fill=\"none\" stroke=\"black\"/>")?;
        writeln!(text, "<text x=\"0\" y=\"-50\" text-anchor=\"middle\">turns</text>")?;
        writeln!(text, "<text x=\"0\" y=\"205\" text-anchor=\"middle\">{caption}</text>\n</svg>")?;
        Ok(text)
    }
}

/// Middle of a sector [degrees].
fn degrees(sector: usize) -> f64 {
    (sector as f64 + 0.5) * 360.0 / SECTORS as f64
}
