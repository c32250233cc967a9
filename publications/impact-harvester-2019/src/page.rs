//! The HTML report.

use super::computed::Computed;
use super::{ReproduceError, Reproduction};
use jounce_plot::report::{Document, Verdict};

/// Assumptions that a run at 13 Hz and 200 N does not test.
const READINGS: [&str; 7] = [
    "Levels of force and frequency step of figure 6 are not printed: 50, 100 and 200 N and 0.1 Hz are guesses (50 and 200 N occur in figures 7 to 9).",
    "`b_c` and `h_c` in eq. (2) are read as the patch's own width and thickness.",
    "The text puts the patch's capacitance in series with the load; eq. (3) has them in parallel, and eq. (3) is used.",
    "\"The first eight modes\" are the table on its spring and the seven bending modes of Table 2, whose measured damping ratios are applied in their order.",
    "Damping was measured with the table fixed and is applied to the modes of beam and table together (8.66 against 8.67 Hz).",
    "Gravity is left out: the motion is horizontal in the paper's figure 2.",
    "The paper integrates with ode45 and does not say how tightly; here every response is computed to a relative error of about 1e-7.",
];

/// Returns the conclusion from Table 2.
pub(super) fn summary(computed: &Computed) -> String {
    let (thin_error, laminate) = computed.table_2.worst_errors();
    let print = if computed.table_2.match_print() {
        "agrees with the paper's model in every printed digit"
    } else {
        "does not agree with the paper's model in every printed digit"
    };
    format!(
        "With the paper's section (a thin skin, no patch mass) our beam {print}. It is up to {:.1} % away from the measurement. The same beam with \
         the patch as a laminate about the shifted neutral axis, its mass included (5440 kg/m³), comes within {:.2} % of the measured \
         frequencies without any tuning.",
        100.0 * thin_error,
        100.0 * laminate
    )
}

/// Builds the complete document.
pub(super) fn page(of: &Reproduction) -> Result<Document, ReproduceError> {
    let mut page = Document::new("The impact energy harvester, computed again");
    let holding = of.claims.iter().filter(|claim| claim.holds).count();
    page.paragraph(&format!(
        "All simulated results of \"Experimental validation of an impact off-resonance energy harvester\" (2019), computed by jounce {} from the \
         paper's data. {holding} of {} claims hold.",
        env!("CARGO_PKG_VERSION"),
        of.claims.len()
    ));
    page.section("Claims");
    page.paragraph("Each verdict follows from the numbers of this report and the criterion that is stated with it.");
    for claim in &of.claims {
        page.claim(
            &claim.claim,
            if claim.holds {
                Verdict::Holds
            } else {
                Verdict::DoesNotHold
            },
            &claim.evidence,
        );
    }
    results(&mut page, of)?;
    for chapter in of.chapters() {
        chapter.write(&mut page)?;
    }
    assumptions(&mut page, of);
    page.section("Data");
    page.paragraph("The folder `tables` holds the data of every table and figure as CSV and JSON, `figures` every picture as SVG, PNG and PDF.");
    Ok(page)
}

/// Adds the tables and figures of the paper in their order, then those with the other stop.
fn results(page: &mut Document, of: &Reproduction) -> Result<(), ReproduceError> {
    page.section("Table 2: natural frequencies");
    page.paragraph(of.summary());
    table(page, of, "table-2");
    page.section("Figures 4 and 5: modal test");
    figures(page, of, &["figure-4", "figure-5"])?;
    page.section("Figure 6: power over frequency");
    page.paragraph(
        "Rings mark points that had not settled after 20 s: without contact the first mode decays by only 1/e in 9.5 s, and some motions never repeat. \
         The grey line is the exact steady state.",
    );
    figures(page, of, &["figure-6", "figure-6-branches"])?;
    page.section("Tuning by the gap");
    page.paragraph(
        "The paper closes with the idea of tuning the harvester by its gap. Between its folds the response depends on the initial state; below the \
         grazing curve the beam does not reach the stop.",
    );
    figures(page, of, &["jumps-over-gap"])?;
    page.section("Figure 7: voltage at 13 Hz and 200 N");
    table(page, of, "runs");
    figures(page, of, &["figure-7", "figure-7-spectrum"])?;
    table(page, of, "figure-7-orders");
    page.section("Figures 8 and 9: power over load resistance");
    figures(page, of, &["figure-8", "figure-9"])?;
    page.section("The stop on the shaker table");
    page.paragraph(
        "Eq. (5) takes the displacement of the contact point in space, so that the stop stands on the ground; if the rig carries it on the table, \
         figures 6, 8 and 9 become these.",
    );
    table(page, of, "claims");
    figures(
        page,
        of,
        &[
            "figure-6-stop-on-table",
            "figure-8-stop-on-table",
            "figure-9-stop-on-table",
        ],
    )?;
    Ok(())
}

fn assumptions(page: &mut Document, of: &Reproduction) {
    page.section("What the paper leaves open");
    page.paragraph(
        "The first row has all defaults; each other row changes one choice (or the two it names). A run that has not settled has no definite mean power: \
         there the numbers only show the order of magnitude.",
    );
    table(page, of, "assumptions");
    page.paragraph("Readings and guesses that are not varied here:");
    page.list(&READINGS);
}

fn table(page: &mut Document, of: &Reproduction, name: &str) {
    if let Some(named) = of.table(name) {
        page.table(&named.caption, &named.table, named.digits);
    }
}

fn figures(page: &mut Document, of: &Reproduction, names: &[&str]) -> Result<(), ReproduceError> {
    for named in names.iter().filter_map(|name| of.figure(name)) {
        page.figure(&named.figure, &named.caption)?;
    }
    Ok(())
}
