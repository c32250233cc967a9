// Where the table comes from: the command, its files, the version.

import type { Table } from "./table";

/** Writes the command that makes the table again, and the text of its files. */
export function origin({ manifest }: Table, host: HTMLElement): void {
    const { record, version, options, spec_sha256 } = manifest;
    const add = (name: "p" | "h3" | "pre", text: string) => {
        const element = document.createElement(name);
        element.textContent = text;
        if (name === "pre") element.tabIndex = 0;
        host.append(element);
    };
    add("p", `jounce ${version}; study ${options.study_sha256 ?? ""}, spec ${spec_sha256} (SHA-256). The downloaded table is in SI units.`);
    if (!record) return;
    add("p", "`jounce rerun FILE`, with the name of this file, computes the table again and compares it bit by bit. It was computed by");
    add("pre", `jounce ${record.arguments.join(" ")} --out FOLDER`);
    for (const { path, text, sha256 } of record.inputs) {
        add("h3", path);
        add("pre", text ?? `SHA-256 ${sha256}`);
    }
}
