//! WAV files.

/// Writes a file of samples of the given kind (1 integer, 3 floating point) and size, with
/// interleaved channels.
pub fn file(kind: u16, size: u16, channels: u16, rate_hz: u32, samples: &[u8]) -> Vec<u8> {
    let mut format = Vec::new();
    for half in [kind, channels] {
        format.extend(half.to_le_bytes());
    }
    format.extend(rate_hz.to_le_bytes());
    format.extend((rate_hz * u32::from(size * channels)).to_le_bytes());
    format.extend((size * channels).to_le_bytes());
    format.extend((8 * size).to_le_bytes());
    let chunk = |name: &[u8], data: &[u8]| {
        let mut bytes = [name, &(data.len() as u32).to_le_bytes(), data].concat();
        bytes.resize(bytes.len().next_multiple_of(2), 0);
        bytes
    };
    let inside = [
        b"WAVE".to_vec(),
        chunk(b"fmt ", &format),
        chunk(b"LIST", b"odd"),
        chunk(b"data", samples),
    ]
    .concat();
    chunk(b"RIFF", &inside)
}
