//! Tables and figure of basins of attraction.

use super::{AttractorResult, BasinsResult, StartPoint};
use crate::error::Error;
use jounce_analysis::GridAxis;
use jounce_io::table::{Column, Table, Values};
use jounce_plot::{Along, Axis, Colour, Figure, Marker, Panel, Series};

impl BasinsResult {
    /// Returns the table of the attractors.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let all = &self.attractors;
        let number = |name: &str, unit: &str, about: &str, value: fn(&AttractorResult) -> f64| {
            number(all, name, unit, about, value)
        };
        let count = |name: &str, about: &str, value: fn(&AttractorResult) -> u64| {
            Column::new(name, "", about, all.iter().map(value).collect::<Vec<u64>>())
        };
        let id: Vec<String> = all.iter().map(|own| own.id.clone()).collect();
        let chaotic: Vec<bool> = all.iter().map(|own| own.chaotic).collect();
        let mirror_of = all.iter().map(|own| own.mirror_of.clone());
        let mirror_of: Vec<String> = mirror_of.map(Option::unwrap_or_default).collect();
        let mut columns = vec![
            Column::new(
                "id",
                "",
                "period in drive cycles and a letter by decreasing power",
                id,
            ),
            count(
                "period_cycles",
                "period in drive cycles, 0 without a period",
                |own| u64::from(own.period_cycles),
            ),
            Column::new("chaotic", "", "neighbouring motions diverge", chaotic),
            Column::new(
                "mirror_of",
                "",
                "id of the orbit whose mirror image, half a drive cycle later, this orbit is",
                mirror_of,
            ),
            number("mean_power_w", "W", "mean power of all loads", |own| {
                own.mean_power_w
            }),
            count("contacts_per_period", "contacts per period", |own| {
                own.contacts_per_period
            }),
        ];
        columns.extend(self.statistics());
        Ok(Table::new(columns)?)
    }

    /// Returns the columns of the exponent and of the share of the starts.
    fn statistics(&self) -> Vec<Column> {
        let number = |name: &str, unit: &str, about: &str, value: fn(&AttractorResult) -> f64| {
            number(&self.attractors, name, unit, about, value)
        };
        vec![
            number(
                "lyapunov_per_s",
                "1/s",
                "largest Lyapunov exponent, NaN on an orbit",
                |own| own.lyapunov_per_s.unwrap_or(f64::NAN),
            ),
            number(
                "lyapunov_error_per_s",
                "1/s",
                "standard error of the exponent, NaN on an orbit",
                |own| own.lyapunov_error_per_s.unwrap_or(f64::NAN),
            ),
            number("fraction", "", "share of the starts", |own| own.fraction),
            number(
                "fraction_low",
                "",
                "lower end of the 95 % interval of the share",
                |own| own.fraction_low,
            ),
            number(
                "fraction_high",
                "",
                "upper end of the 95 % interval of the share",
                |own| own.fraction_high,
            ),
        ]
    }

    /// Returns the table of the starts, in order.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn starts_table(&self) -> Result<Table, Error> {
        let all = &self.points;
        let column = |name: &str, unit: &str, about: &str, values: Values| {
            Column::new(name, unit, about, values)
        };
        let number = |value: fn(&StartPoint) -> f64| {
            Values::from(all.iter().map(value).collect::<Vec<f64>>())
        };
        let is_failed = |index: usize| self.failed.iter().any(|failed| failed.start == index);
        let attractor = |(index, point): (usize, &StartPoint)| match point.attractor {
            Some(number) => self.attractors[number].id.clone(),
            None if is_failed(index) => "failed".to_owned(),
            None => "not computed".to_owned(),
        };
        let attractor: Vec<String> = all.iter().enumerate().map(attractor).collect();
        let index: Vec<u64> = (0..all.len() as u64).collect();
        Ok(Table::new(vec![
            column("start", "", "number of the start, from 0", index.into()),
            column(
                "displacement_m",
                "m",
                "displacement towards the stop",
                number(|point| point.displacement_m),
            ),
            column(
                "velocity_m_s",
                "m/s",
                "velocity towards the stop",
                number(|point| point.velocity_m_s),
            ),
            column(
                "voltage_v",
                "V",
                "voltage of the first patch",
                number(|point| point.voltage_v),
            ),
            column("attractor", "", "id of the attractor", attractor.into()),
        ])?)
    }

    /// Returns the figure of the starts: by displacement and velocity towards the stop, or by the
    /// sides of their grid, coloured by attractor.
    pub fn figure(&self) -> Figure {
        let plane = match self.sides[..] {
            [first, second, ..] => [first, second],
            [GridAxis::Voltage] => [GridAxis::Voltage, GridAxis::Velocity],
            _ => [GridAxis::Displacement, GridAxis::Velocity],
        };
        let [x, y] = plane.map(axis);
        let marker = if self.sides.is_empty() {
            Marker::Circle
        } else {
            Marker::Square
        };
        let mut panel = Panel::new(x, y).high(380.0);
        for (number, attractor) in self.attractors.iter().enumerate() {
            let own = self
                .points
                .iter()
                .filter(|point| point.attractor == Some(number));
            let (x, y) = own
                .map(|point| (value(plane[0], point), value(plane[1], point)))
                .unzip();
            let series = Series::points(x, y, marker).colour(Colour::nth(number));
            panel = panel.with(series.label(&attractor.id));
        }
        let gap_m = self.gap_m.filter(|_| plane[0] == GridAxis::Displacement);
        let across_m = self.gap_m.filter(|_| plane[1] == GridAxis::Displacement);
        for (along, gap_m) in [(Along::X, gap_m), (Along::Y, across_m)] {
            panel = gap_m.into_iter().fold(panel, |panel, gap_m| {
                panel.reference(along, gap_m, Some("gap"))
            });
        }
        Figure::new("Basins of attraction").with(panel)
    }
}

fn number(
    all: &[AttractorResult],
    name: &str,
    unit: &str,
    about: &str,
    value: fn(&AttractorResult) -> f64,
) -> Column {
    let values: Vec<f64> = all.iter().map(value).collect();
    Column::new(name, unit, about, values)
}

fn axis(axis: GridAxis) -> Axis {
    match axis {
        GridAxis::Displacement => Axis::linear("Displacement towards the stop", "m"),
        GridAxis::Velocity => Axis::linear("Velocity", "m/s"),
        GridAxis::Voltage => Axis::linear("Voltage", "V"),
    }
}

fn value(axis: GridAxis, point: &StartPoint) -> f64 {
    match axis {
        GridAxis::Displacement => point.displacement_m,
        GridAxis::Velocity => point.velocity_m_s,
        GridAxis::Voltage => point.voltage_v,
    }
}
