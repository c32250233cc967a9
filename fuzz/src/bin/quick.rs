//! Readers of short texts. A small program is faster: libFuzzer clears the counters of all its code before each input.
#![no_main]

libfuzzer_sys::fuzz_target!(
    init: jounce_fuzz::choose(jounce_fuzz::readers::QUICK),
    |data: &[u8]| jounce_fuzz::read(data)
);
