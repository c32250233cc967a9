//! TDMS files.

/// A property of an object.
pub enum Property {
    Number(&'static str, f64),
    Text(&'static str, &'static str),
}

/// Channel of a segment: path, values, properties.
pub struct Channel {
    pub path: &'static str,
    pub values: Vec<f64>,
    pub properties: Vec<Property>,
}

fn text(text: &str) -> Vec<u8> {
    [&(text.len() as u32).to_le_bytes(), text.as_bytes()].concat()
}

/// Writes a segment with its metadata and one chunk of doubles, channel by channel or interleaved.
pub fn segment(channels: &[Channel], interleaved: bool, closed: bool) -> Vec<u8> {
    let mut metadata = (channels.len() as u32).to_le_bytes().to_vec();
    for channel in channels {
        metadata.extend(text(channel.path));
        metadata.extend([20_u32, 10, 1].iter().flat_map(|word| word.to_le_bytes()));
        metadata.extend((channel.values.len() as u64).to_le_bytes());
        metadata.extend((channel.properties.len() as u32).to_le_bytes());
        for property in &channel.properties {
            match property {
                Property::Number(name, x) => metadata.extend(
                    [
                        text(name),
                        10_u32.to_le_bytes().to_vec(),
                        x.to_le_bytes().to_vec(),
                    ]
                    .concat(),
                ),
                Property::Text(name, value) => metadata
                    .extend([text(name), 0x20_u32.to_le_bytes().to_vec(), text(value)].concat()),
            }
        }
    }
    let longest = channels
        .iter()
        .map(|channel| channel.values.len())
        .max()
        .unwrap_or(0);
    let numbers: Vec<f64> = if interleaved {
        (0..longest)
            .flat_map(|k| channels.iter().map(move |channel| channel.values[k]))
            .collect()
    } else {
        channels
            .iter()
            .flat_map(|channel| channel.values.clone())
            .collect()
    };
    let data: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
    let marks: u32 = 1 << 1 | 1 << 2 | 1 << 3 | if interleaved { 1 << 5 } else { 0 };
    let next = if closed {
        (metadata.len() + data.len()) as u64
    } else {
        u64::MAX
    };
    let lead = [
        b"TDSm".to_vec(),
        marks.to_le_bytes().to_vec(),
        4713_u32.to_le_bytes().to_vec(),
    ]
    .concat();
    [
        lead,
        next.to_le_bytes().to_vec(),
        (metadata.len() as u64).to_le_bytes().to_vec(),
        metadata,
        data,
    ]
    .concat()
}
