//! Members of an ensemble and their running mean.

use crate::{Along, Axis, Colour, Figure, Marker, Panel, Series};

/// Draws the mean power of each member, W, the running mean, and the 95 % interval of the mean of
/// all.
pub fn ensemble(title: &str, power_w: &[f64], low_w: f64, high_w: f64) -> Figure {
    let number: Vec<f64> = (1..=power_w.len()).map(|k| k as f64).collect();
    let mut sum = 0.0;
    let running = power_w.iter().zip(&number).map(|(power, count)| {
        sum += power;
        sum / count
    });
    let running = Series::line(number.clone(), running.collect()).label("mean so far");
    let members = Series::points(number, power_w.to_vec(), Marker::Ring)
        .colour(Colour::nth(1))
        .label("member");
    let panel = Panel::new(Axis::linear("Member", ""), Axis::linear("Mean power", "W")).high(320.0);
    Figure::new(title).with(
        panel
            .band(Along::Y, low_w, high_w, Some("95 % interval of the mean"))
            .with(members)
            .with(running),
    )
}
