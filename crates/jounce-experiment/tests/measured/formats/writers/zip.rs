//! ZIP archives, as `numpy.savez` writes them.

use std::io::Write as _;

pub fn file(entries: &[(&str, Vec<u8>)], compressed: bool) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut archive = rawzip::ZipArchiveWriter::new(&mut bytes);
    for (name, content) in entries {
        let method = if compressed {
            rawzip::CompressionMethod::DEFLATE
        } else {
            rawzip::CompressionMethod::STORE
        };
        let (mut entry, config) = archive
            .new_file(name)
            .compression_method(method)
            .start()
            .expect("an entry");
        let packed = if compressed {
            let mut writer = config.wrap(flate2::write::DeflateEncoder::new(
                &mut entry,
                flate2::Compression::default(),
            ));
            writer.write_all(content).expect("memory");
            let (encoder, descriptor) = writer.finish().expect("memory");
            encoder.finish().expect("memory");
            descriptor
        } else {
            let mut writer = config.wrap(&mut entry);
            writer.write_all(content).expect("memory");
            writer.finish().expect("memory").1
        };
        entry.finish(packed).expect("an entry");
    }
    archive.finish().expect("an archive");
    bytes
}
