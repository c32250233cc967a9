// Shows the lines of the file that the changed values change, and saves them.

import type { Design } from "./design";
import { difference } from "./difference";
import type { Head } from "./frame";
import type { Wire } from "./wire";

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

export class Save {
    private readonly dialog = find<HTMLDialogElement>("save-dialog");
    private readonly write = find<HTMLButtonElement>("save-write");
    private readonly words = find("save-words");
    private before = "";
    /** True from a save until the server reports the change of the file. */
    private isSaved = false;

    constructor(private readonly wire: Wire, private readonly design: Design) {
        wire.on("save", ({ head }) => this.saved(head));
        this.write.onclick = () => this.wire.ask("save", { set: this.design.pairs, before: this.before });
    }

    /** Shows the difference between the file and the design. */
    open({ spec, file, has_file }: Head, name: string): void {
        this.before = file;
        const lines = difference(file, spec);
        find("save-difference").textContent = lines.join("\n") || "The values are those of the file.";
        this.words.textContent = has_file ? "" : "This spec has no file; export it instead.";
        this.write.textContent = `Save to ${name.split(/[\\/]/).pop()}`;
        this.write.disabled = !has_file || lines.length === 0;
        if (!this.dialog.open) this.dialog.showModal();
    }

    /** Returns whether a change of the file is that of the last save. */
    takeChange(): boolean {
        const { isSaved } = this;
        this.isSaved = false;
        return isSaved;
    }

    private saved(head: Head): void {
        if (head.stage === "fault") {
            this.words.textContent = head.faults[0]?.message ?? "";
            return;
        }
        this.dialog.close();
        this.isSaved = true;
        // The file now has the values.
        this.design.fileChanged();
        this.design.reset();
    }
}
