//! Drawing of a design, and the keys that move when its parts are dragged.

use super::Design;
use jounce_plot::show;
use jounce_plot::{Drawing, DrawnShape, GripPart, Rect, ViewRoom};
use serde::Serialize;

/// Scale drawing of a design.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DesignDrawing {
    /// The drawing, SVG.
    pub svg: String,
    /// Side view: left and upper edge, width, height, px.
    pub side: [f64; 4],
    /// Circuits and close-ups, px.
    pub cells: Vec<[f64; 4]>,
    /// Plan views of plates, px.
    pub plans: Vec<[f64; 4]>,
    /// Parts that can be dragged.
    pub grips: Vec<Grip>,
}

/// Part that can be dragged, with the keys that it moves.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Grip {
    /// Kind.
    pub kind: GripKind,
    /// Name of the patch or stop.
    pub name: String,
    /// Key that it moves.
    pub key: String,
    /// Key of the length that changes with the start of a patch.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length: Option<String>,
    /// Position, px.
    pub at: [f64; 2],
    /// Scale: px per metre of the key, along both axes.
    pub px_per_m: [f64; 2],
}

/// Kind of a grip.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum GripKind {
    /// Start of a patch.
    Start,
    /// End of a patch.
    End,
    /// Position of a stop along its beam.
    Place,
    /// Gap of a stop.
    Gap,
}

impl Design {
    /// Draws the design to scale, in a room if one is given.
    ///
    /// ```
    /// use jounce::{Harvester, live::Design};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let drawing = Design::new(&harvester, &[])?.drawing("harvester", None);
    /// assert!(drawing.grips.iter().any(|grip| grip.key == "stop.tip.gap"));
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn drawing(&self, title: &str, room: Option<ViewRoom>) -> DesignDrawing {
        let drawing = show::drawing(title, self.spec());
        let sheet = room.map_or_else(|| drawing.sheet(), |room| drawing.sheet_in(room));
        let grip = |grip: &jounce_plot::Grip| {
            let (kind, name, key, length) = self.moved(&drawing, grip.part)?;
            Some(Grip {
                kind,
                name,
                key,
                length,
                at: grip.at.into(),
                px_per_m: grip.px_per_m.into(),
            })
        };
        DesignDrawing {
            side: extent(&sheet.side),
            cells: sheet
                .circuits
                .iter()
                .chain(&sheet.looks)
                .map(extent)
                .collect(),
            plans: sheet.plans.iter().map(extent).collect(),
            grips: sheet.grips.iter().filter_map(grip).collect(),
            svg: sheet.svg,
        }
    }

    /// Returns kind, name, and the keys that a grip moves; `None` where no number of the spec
    /// defines the position, such as a stop at the end of a beam.
    fn moved(
        &self,
        drawing: &Drawing,
        part: GripPart,
    ) -> Option<(GripKind, String, String, Option<String>)> {
        let patch = |body: usize, patch: usize| match &drawing.bodies[body].shape {
            DrawnShape::Beam(beam) => Some(beam.patches[patch].label.clone()),
            _ => None,
        };
        let stop = |contact: usize| drawing.contacts[contact].label.clone();
        let (kind, name) = match part {
            GripPart::PatchStart { body, patch: index } => (GripKind::Start, patch(body, index)?),
            GripPart::PatchEnd { body, patch: index } => (GripKind::End, patch(body, index)?),
            GripPart::Place { contact } => (GripKind::Place, stop(contact)),
            GripPart::Gap { contact } => (GripKind::Gap, stop(contact)),
        };
        let (key, length) = match kind {
            GripKind::Start => (
                format!("patch.{name}.start"),
                Some(format!("patch.{name}.length")),
            ),
            GripKind::End => (format!("patch.{name}.length"), None),
            GripKind::Place => {
                let (beam, point) = self.spec().stop.get(&name)?.at.split_once('.')?;
                let key = format!("beam.{beam}.point.{point}");
                self.key(&key).ok()?;
                (key, None)
            }
            GripKind::Gap => (format!("stop.{name}.gap"), None),
        };
        Some((kind, name, key, length))
    }
}

fn extent(rect: &Rect) -> [f64; 4] {
    [rect.left, rect.top, rect.width(), rect.height()]
}
