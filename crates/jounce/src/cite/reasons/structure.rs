//! Beams, plates, patches and circuits.

use super::Reasons;
use jounce_spec::{DriveKind, Interface, Section, Spec};

pub(super) fn add(spec: &Spec, reasons: &mut Reasons) {
    beams(spec, reasons);
    plates(spec, reasons);
    patches(spec, reasons);
    circuits(spec, reasons);
}

fn beams(spec: &Spec, reasons: &mut Reasons) {
    for name in spec.beam.keys() {
        reasons.add(
            "szabo-babuska-1991",
            format!("beam {name}: hierarchical elements"),
        );
    }
    let moves_base = spec
        .drive
        .values()
        .any(|drive| drive.kind != DriveKind::Force);
    if moves_base && !spec.beam.is_empty() {
        reasons.add("erturk-inman-2008", "beams under motion of their base");
    }
}

fn plates(spec: &Spec, reasons: &mut Reasons) {
    for name in spec.plate.keys() {
        reasons.add("bogner-1966", format!("plate {name}: conforming elements"));
        let model = format!("plate {name}: piezoelectric thin plate by finite elements");
        reasons.add("de-marqui-2009", model);
        reasons.add("reddy-2004", format!("plate {name}: laminate"));
    }
}

fn patches(spec: &Spec, reasons: &mut Reasons) {
    for (name, patch) in &spec.patch {
        match patch.section {
            Section::ThinSkin => {
                reasons.add("impact-harvester-2019", format!("patch {name}: thin skin"));
            }
            Section::Laminate => {
                let laminate = format!("patch {name}: piezoelectric laminate");
                reasons.add("erturk-inman-2011", laminate);
            }
        }
        if patch.pores.porosity.is_some() {
            let pores = format!("patch {name}: constants of a porous material");
            reasons.add("dunn-taya-1993", pores.clone());
            reasons.add("martinez-ayuso-2017", pores);
        }
        if patch.foils.thickness_m.is_some() {
            reasons.add(
                "bilgen-2010",
                format!("patch {name}: layers of a fibre composite"),
            );
        }
    }
}

fn circuits(spec: &Spec, reasons: &mut Reasons) {
    for (name, circuit) in &spec.circuit {
        let (keys, what): (&[&str], _) = match circuit.interface {
            Interface::Resistor => continue,
            Interface::Bridge => (&["shu-lien-2006"], "full bridge"),
            Interface::ParallelSshi => (&["shu-lien-2006", "guyomar-2005"], "parallel SSHI"),
            Interface::SeriesSshi => (&["shu-lien-2006", "guyomar-2005"], "series SSHI"),
            Interface::Sece => (&["lefeuvre-2006"], "synchronous charge extraction"),
        };
        for key in keys {
            reasons.add(key, format!("circuit {name}: {what}"));
        }
    }
}
