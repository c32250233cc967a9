//! All other readers, and the first inputs of all.
#![no_main]

libfuzzer_sys::fuzz_target!(
    init: {
        jounce_fuzz::seeds_if_chosen();
        jounce_fuzz::choose(jounce_fuzz::readers::OTHER);
    },
    |data: &[u8]| jounce_fuzz::read(data)
);
