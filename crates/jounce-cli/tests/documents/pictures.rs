//! Pictures of the gallery, of the tutorial and of the page on design: each is the file that a command of its page writes.

use super::root;
use std::path::Path;

/// Pages whose commands draw their pictures, by the begin of the path, and the folder into which the commands write.
const PAGES: [(&str, &str); 3] = [
    ("book/src/gallery.md", "gallery"),
    ("book/src/howto/design.md", "best"),
    ("book/src/tutorial/", "tutorial"),
];

/// Faults of the pictures of a page after its commands ran in a folder. With `JOUNCE_WRITE=1` the stored pictures are replaced.
pub fn faults(document: &str, folder: &Path) -> Vec<String> {
    let Some((_, set)) = PAGES.iter().find(|(page, _)| document.starts_with(page)) else {
        return Vec::new();
    };
    let page = std::fs::read_to_string(root().join(document)).expect("documents are UTF-8");
    let pictures = format!("pictures/{set}/");
    let names: Vec<&str> = page
        .split(pictures.as_str())
        .skip(1)
        .filter_map(|rest| rest.split(')').next())
        .collect();
    let mut faults: Vec<String> = names
        .iter()
        .filter_map(|name| fault(document, &format!("{set}/{name}"), folder))
        .collect();
    if names.is_empty() {
        faults.push(format!("{document} shows no picture of {pictures}"));
    }
    faults
}

/// Fault of one picture, by its path in the folders of the pictures and of the commands.
fn fault(document: &str, picture: &str, folder: &Path) -> Option<String> {
    let stored = root().join("book/src/pictures").join(picture);
    let Ok(drawn) = std::fs::read(folder.join(picture)) else {
        return Some(format!("{document}: no command writes {picture}"));
    };
    if std::env::var_os("JOUNCE_WRITE").is_some() {
        std::fs::create_dir_all(stored.parent().expect("a picture is in a folder"))
            .and_then(|()| std::fs::write(&stored, &drawn))
            .expect("pictures can be written");
    }
    let is_same = std::fs::read(&stored).is_ok_and(|old| old == drawn);
    (!is_same).then(|| {
        format!(
            "{document}: {picture} is not the picture that its command draws; draw it again: \
             JOUNCE_WRITE=1 cargo test --release -p jounce-cli --test documents"
        )
    })
}
