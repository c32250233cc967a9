// Files that are dropped on the page.

/** Calls `take` with the first file of each drop and the element under it. */
export function acceptDrops(take: (file: File, target: Node) => void): void {
    const mark = (isOver: boolean) => document.body.classList.toggle("dropping", isOver);
    addEventListener("dragover", (event) => {
        event.preventDefault();
        mark(true);
    });
    addEventListener("dragleave", () => mark(false));
    addEventListener("drop", (event) => {
        event.preventDefault();
        mark(false);
        const file = event.dataTransfer?.files[0];
        if (file) take(file, event.target as Node);
    });
}
