//! Names of times and frequencies.

/// True for names of a time.
pub(in crate::read) fn is_time(name: &str) -> bool {
    let lowercase = name.trim().to_lowercase();
    let full_names = [
        "t",
        "time",
        "zeit",
        "x_value",
        "timestamp",
        "uhrzeit",
        "temps",
        "elapsed",
        "datetime",
        "date time",
        "date/time",
    ];
    time_unit(name).is_some()
        || full_names.contains(&lowercase.as_str())
        || ["time", "timestamp", "t_", "t ["]
            .iter()
            .any(|start| lowercase.starts_with(start))
}

/// Unit implied by a name: `seconds`, `millis`.
pub(in crate::read) fn time_unit(name: &str) -> Option<&'static str> {
    match name.trim().to_lowercase().as_str() {
        "s" | "sec" | "second" | "seconds" | "sekunden" => Some("s"),
        "ms" | "msec" | "millis" | "millisecond" | "milliseconds" => Some("ms"),
        "us" | "usec" | "micros" | "microsecond" | "microseconds" => Some("us"),
        "ns" | "nsec" | "nanosecond" | "nanoseconds" => Some("ns"),
        _ => None,
    }
}

/// True for names of a frequency.
pub(in crate::read) fn is_frequency(name: &str) -> bool {
    let lowercase = name.trim().to_lowercase();
    lowercase == "f"
        || lowercase == "hz"
        || lowercase.starts_with("freq")
        || lowercase.starts_with("f_hz")
        || lowercase.starts_with("f [")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_times_and_frequencies_are_known() {
        assert!(is_time("Time") && is_time("timestamp_ms") && is_time("t") && !is_time("tip"));
        assert!(is_frequency("Frequency [Hz]") && !is_frequency("force"));
    }
}
