//! `jounce show`: the file of the drawing and its folder.

use crate::{SPEC, jounce_in};

#[test]
fn a_missing_folder_is_created_for_a_drawing_only() {
    let folder = tempfile::tempdir().unwrap();
    let show = |out: &str| jounce_in(folder.path(), &["show", SPEC, "--out", out]);
    let (code, stdout, stderr) = show("new/folder/drawing.svg");
    assert_eq!(
        (code, stdout.trim()),
        (0, "new/folder/drawing.svg"),
        "{stderr}"
    );
    let drawing = std::fs::read_to_string(folder.path().join("new/folder/drawing.svg")).unwrap();
    assert!(drawing.starts_with("<svg"));

    let (code, _, stderr) = show("other/drawing.gif");
    assert!(
        code == 4 && stderr.contains("use .svg, .png or .pdf"),
        "{stderr}"
    );
    assert!(!folder.path().join("other").exists());

    std::fs::write(folder.path().join("file"), "").unwrap();
    let (code, _, stderr) = show("file/drawing.svg");
    assert!(code == 4 && stderr.contains("\"file\""), "{stderr}");
}
