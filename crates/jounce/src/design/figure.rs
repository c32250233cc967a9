//! Figure of a design: the search and the limits, or the front.

use super::DesignResult;
use super::report::unit;
use jounce_design::{Goal, LimitResult};
use jounce_plot::{Along, Axis, Colour, Figure, Line, Marker, Panel, Series};

/// Height of the rows of limits, pixels.
const ROW_PX: f64 = 32.0;

/// Smallest end of the axis of the limits, relative to a limit: shows that a lower one allows more.
const LEAST_END: f64 = 1.25;

impl DesignResult {
    /// Returns the figure: the front of several goals, or the better and better designs next to the
    /// spec as given; then how much of each limit the best design uses.
    pub fn figure(&self) -> Figure {
        let outcome = &self.outcome;
        let names: Vec<&String> = outcome.best.goals.keys().collect();
        let search = match &names[..] {
            [first, second, ..] if !outcome.front.is_empty() => self.front_panel(first, second),
            _ => self.trace_panel(names.first().map_or("goal", |name| name.as_str())),
        };
        let figure = Figure::new("Design").with(search);
        match outcome.limits.is_empty() {
            true => figure,
            false => figure.with(limits_panel(&outcome.limits)),
        }
    }

    fn front_panel(&self, first: &str, second: &str) -> Panel {
        let of = |name: &str| {
            let front = self.outcome.front.iter();
            front.map(|one| one.goals[name]).collect()
        };
        let panel = Panel::new(axis(first), axis(second)).high(380.0);
        panel.with(Series::points(of(first), of(second), Marker::Circle))
    }

    /// Goal of the best design so far, which stays until the next better one, and of the spec.
    fn trace_panel(&self, goal: &str) -> Panel {
        let outcome = &self.outcome;
        let found = || outcome.trace.iter().filter(|one| one.violation == 0.0);
        let (mut x, mut y) = (Vec::new(), Vec::new());
        for one in found() {
            if let Some(last) = y.last().copied() {
                x.push(one.evaluation as f64);
                y.push(last);
            }
            x.push(one.evaluation as f64);
            y.push(one.goal);
        }
        x.extend(x.last().map(|_| outcome.evaluations as f64));
        y.extend(y.last().copied());
        let places = found().map(|one| one.evaluation as f64).collect();
        let goals = found().map(|one| one.goal).collect();
        let mut panel = Panel::new(Axis::linear("Evaluations", ""), axis(goal)).high(300.0);
        if let Some(before) = outcome.before.goals.get(goal) {
            let label = match outcome.before.violation {
                Some(0.0) => "spec as given",
                _ => "spec as given, beyond the limits",
            };
            let span = vec![0.0, outcome.evaluations as f64];
            let line = Series::line(span, vec![*before; 2]).style(Line::Dashed);
            panel = panel.with(line.label(label));
        }
        panel
            .with(Series::line(x, y).label("best design within the limits"))
            .with(Series::points(places, goals, Marker::Circle))
    }
}

/// Returns the allowed values of each limit, relative to it, as a line, and the value of the best design
/// as a circle: an upper limit allows all below it, a lower one all above.
fn limits_panel(limits: &[LimitResult]) -> Panel {
    let rows: Vec<f64> = (0..limits.len())
        .map(|k| (limits.len() - k) as f64)
        .collect();
    let used: Vec<f64> = limits.iter().map(|one| one.value / one.limit).collect();
    let end = used.iter().copied().fold(LEAST_END, f64::max);
    let mut panel = Panel::new(
        Axis::linear("Value relative to its limit", ""),
        Axis::linear("Limit", ""),
    )
    .high(80.0 + ROW_PX * rows.len() as f64)
    .reference(Along::X, 1.0, None);
    for (k, (limit, row)) in limits.iter().zip(&rows).enumerate() {
        let text = format!("{} {}: {}", limit.name, limit.comparison(4), limit.state());
        let allowed = if limit.is_lower {
            [1.0, end]
        } else {
            [0.0, 1.0]
        };
        let line = Series::line(allowed.to_vec(), vec![*row; 2]);
        let line = if k == 0 { line.label("allowed") } else { line };
        panel = panel
            .with(line.colour(Colour::nth(0)))
            .note(0.5, *row, &text);
    }
    let values = Series::points(used, rows, Marker::Circle).label("best design");
    panel.with(values.colour(Colour::nth(1)))
}

fn axis(goal: &str) -> Axis {
    Axis::linear(Goal::named(goal).map_or("Goal", Goal::title), unit(goal))
}
