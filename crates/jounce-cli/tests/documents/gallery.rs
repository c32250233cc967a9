//! Pictures of the gallery: each is the file that the command above it writes.

use super::root;
use std::path::Path;

/// The page of the gallery.
pub const PAGE: &str = "book/src/gallery.md";

/// Folder of the pictures, relative to the page; the commands write into `gallery/`.
const PICTURES: &str = "pictures/gallery/";

/// Faults of the pictures after the commands of the page ran in a folder. With `JOUNCE_WRITE=1` the stored pictures are replaced.
pub fn faults(folder: &Path) -> Vec<String> {
    let page = std::fs::read_to_string(root().join(PAGE)).expect("the gallery is there");
    let pictures: Vec<&str> = page
        .split(PICTURES)
        .skip(1)
        .filter_map(|rest| rest.split(')').next())
        .collect();
    let mut faults: Vec<String> = pictures
        .iter()
        .filter_map(|name| fault(name, folder))
        .collect();
    if pictures.is_empty() {
        faults.push(format!("{PAGE} shows no picture of {PICTURES}"));
    }
    faults
}

fn fault(name: &str, folder: &Path) -> Option<String> {
    let stored = root().join("book/src").join(PICTURES).join(name);
    let Ok(drawn) = std::fs::read(folder.join("gallery").join(name)) else {
        return Some(format!("{PAGE}: no command writes gallery/{name}"));
    };
    if std::env::var_os("JOUNCE_WRITE").is_some() {
        std::fs::create_dir_all(stored.parent().expect("a picture is in a folder"))
            .and_then(|()| std::fs::write(&stored, &drawn))
            .expect("pictures can be written");
    }
    let is_same = std::fs::read(&stored).is_ok_and(|old| old == drawn);
    (!is_same).then(|| {
        format!(
            "{PAGE}: {name} is not the picture that its command draws; draw it again: \
             JOUNCE_WRITE=1 cargo test --release -p jounce-cli --test documents"
        )
    })
}
