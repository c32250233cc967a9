//! MAT files of version 5.

/// A variable of MATLAB.
#[derive(Debug, Clone)]
pub enum Value {
    /// Columns of numbers.
    Columns(Vec<Vec<f64>>),
    /// Real and imaginary parts of an array of any size; the first dimension varies fastest.
    Complex(Vec<u32>, Vec<f64>, Vec<f64>),
    /// Integers of two bytes, stored as such.
    Short(Vec<i16>),
    Text(&'static str),
    Cell(Vec<Value>),
    /// One struct or several, each with the values of all fields.
    Structs(Vec<&'static str>, Vec<Vec<Value>>),
}

pub fn column(values: &[f64]) -> Value {
    Value::Columns(vec![values.to_vec()])
}

pub fn one(fields: Vec<(&'static str, Value)>) -> Value {
    let (names, values) = fields.into_iter().unzip();
    Value::Structs(names, vec![values])
}

/// Writes a file of variables, each compressed or not.
pub fn file(variables: &[(&str, Value)], compressed: bool) -> Vec<u8> {
    let mut bytes = format!("{:<116}", "MATLAB 5.0 MAT-file, made by a test").into_bytes();
    bytes.extend([0; 8]);
    bytes.extend([0x00, 0x01, b'I', b'M']);
    for (name, value) in variables {
        let matrix = matrix(name, value);
        if compressed {
            let mut encoder =
                flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
            std::io::Write::write_all(&mut encoder, &matrix).expect("memory");
            let packed = encoder.finish().expect("memory");
            bytes.extend(15_u32.to_le_bytes());
            bytes.extend((packed.len() as u32).to_le_bytes());
            bytes.extend(packed);
        } else {
            bytes.extend(matrix);
        }
    }
    bytes
}

fn element(kind: u32, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    if (1..=4).contains(&data.len()) {
        bytes.extend(((data.len() as u32) << 16 | kind).to_le_bytes());
        bytes.extend(data);
        bytes.resize(8, 0);
        return bytes;
    }
    bytes.extend(kind.to_le_bytes());
    bytes.extend((data.len() as u32).to_le_bytes());
    bytes.extend(data);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}

fn words(values: &[u32]) -> Vec<u8> {
    values.iter().flat_map(|x| x.to_le_bytes()).collect()
}

fn doubles(values: &[f64]) -> Vec<u8> {
    element(
        9,
        &values
            .iter()
            .flat_map(|x| x.to_le_bytes())
            .collect::<Vec<u8>>(),
    )
}

fn matrix(name: &str, value: &Value) -> Vec<u8> {
    let (class, sizes) = match value {
        Value::Columns(columns) => (6, vec![columns[0].len() as u32, columns.len() as u32]),
        Value::Complex(sizes, ..) => (6 | 0x800, sizes.clone()),
        Value::Short(values) => (10, vec![values.len() as u32, 1]),
        Value::Text(text) => (4, vec![1, text.len() as u32]),
        Value::Cell(cells) => (1, vec![1, cells.len() as u32]),
        Value::Structs(_, each) => (2, vec![1, each.len() as u32]),
    };
    let mut bytes = [
        element(6, &words(&[class, 0])),
        element(5, &words(&sizes)),
        element(1, name.as_bytes()),
    ]
    .concat();
    match value {
        Value::Columns(columns) => bytes.extend(doubles(&columns.concat())),
        Value::Complex(_, real, imaginary) => {
            bytes.extend([doubles(real), doubles(imaginary)].concat())
        }
        Value::Short(values) => bytes.extend(element(
            3,
            &values
                .iter()
                .flat_map(|x| x.to_le_bytes())
                .collect::<Vec<u8>>(),
        )),
        Value::Text(text) => bytes.extend(element(
            4,
            &text
                .encode_utf16()
                .flat_map(u16::to_le_bytes)
                .collect::<Vec<u8>>(),
        )),
        Value::Cell(cells) => cells.iter().for_each(|cell| bytes.extend(matrix("", cell))),
        Value::Structs(names, each) => {
            bytes.extend(element(5, &words(&[32])));
            let padded: Vec<u8> = names
                .iter()
                .flat_map(|name| format!("{name:\0<32}").into_bytes())
                .collect();
            bytes.extend(element(1, &padded));
            each.iter()
                .flatten()
                .for_each(|value| bytes.extend(matrix("", value)));
        }
    }
    element(14, &bytes)
}
