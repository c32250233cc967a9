//! A plate with everything bonded and fixed to it, and its grid lines.

use super::laminate::Laminate;
use jounce_spec::{Layer, Mass, Patch, Plate, PlateArea, PlatePoint, Spec};

/// Distance, relative to the side of the plate, below which two grid lines are merged.
const MIN_CUT_DISTANCE: f64 = 1e-9;

/// A plate of a spec.
#[derive(Debug, Clone)]
pub(super) struct PlateLayout<'a> {
    pub name: &'a str,
    pub plate: &'a Plate,
    layers: Vec<(PlateArea, &'a Layer)>,
    /// Patches with their names and areas.
    pub patches: Vec<(&'a str, PlateArea, &'a Patch)>,
    /// Masses fixed to points of the plate.
    pub masses: Vec<(&'a str, &'a Mass, PlatePoint)>,
}

impl<'a> PlateLayout<'a> {
    /// Collects the layers, patches and masses of a plate.
    pub fn new(spec: &'a Spec, name: &'a str, plate: &'a Plate) -> Self {
        let layers = spec.layer.values().filter(|layer| layer.on == name);
        let patches = spec.patch.iter().filter(|(_, patch)| patch.on == name);
        let on_plate = |(mass_name, mass): (&'a String, &'a Mass)| {
            let (of, point) = mass.on.split_once('.')?;
            let place = plate.point.get(point).filter(|_| of == name)?;
            Some((mass_name.as_str(), mass, *place))
        };
        Self {
            name,
            plate,
            layers: layers
                .map(|l| (plate.area(l.start_m, l.length_m, l.width_m, &l.on_plate), l))
                .collect(),
            patches: patches
                .map(|(patch_name, p)| {
                    let area = plate.area(p.start_m, p.length_m, p.width_m, &p.on_plate);
                    (patch_name.as_str(), area, p)
                })
                .collect(),
            masses: spec.mass.iter().filter_map(on_plate).collect(),
        }
    }

    /// Returns the grid lines across x and across y, m: edges of the plate, the layers and the
    /// patches.
    pub fn cuts_m(&self) -> [Vec<f64>; 2] {
        let areas = || {
            let layers = self.layers.iter().map(|(area, _)| *area);
            layers.chain(self.patches.iter().map(|(_, area, _)| *area))
        };
        let along = |side_m: f64, range: fn(PlateArea) -> [f64; 2]| {
            let inner = areas().flat_map(range).filter(|cut| {
                *cut > MIN_CUT_DISTANCE * side_m && *cut < (1.0 - MIN_CUT_DISTANCE) * side_m
            });
            let mut cuts: Vec<f64> = [0.0, side_m].into_iter().chain(inner).collect();
            cuts.sort_by(f64::total_cmp);
            cuts.dedup_by(|later, before| *later - *before < MIN_CUT_DISTANCE * side_m);
            cuts
        };
        [
            along(self.plate.length_m, |area| area.x_m),
            along(self.plate.width_m, |area| area.y_m),
        ]
    }

    /// Returns the laminate at a point that lies on no grid line.
    pub fn laminate_at(&self, point: PlatePoint) -> Laminate {
        let layers = self.layers.iter().filter(|(area, _)| covers(area, point));
        let patches = self.patches_at(point);
        Laminate::new(
            self.plate,
            layers.map(|(_, layer)| *layer),
            patches.map(|(_, patch)| patch),
        )
    }

    /// Returns the patches at a point, with their indices.
    pub fn patches_at(&self, point: PlatePoint) -> impl Iterator<Item = (usize, &'a Patch)> {
        let patches = self.patches.iter().enumerate();
        patches
            .filter(move |(_, (_, area, _))| covers(area, point))
            .map(|(index, (_, _, patch))| (index, *patch))
    }
}

fn covers(area: &PlateArea, point: PlatePoint) -> bool {
    let within = |range: [f64; 2], at: f64| range[0] < at && at < range[1];
    within(area.x_m, point.x_m) && within(area.y_m, point.y_m)
}
