// Text that the user types: until it is entered, no response overwrites it.

let typed: EventTarget | null = null;
addEventListener("input", (event) => (typed = event.target), true);
for (const end of ["change", "focusout"]) addEventListener(end, () => (typed = null), true);
addEventListener("keydown", ({ key }) => key === "Enter" && (typed = null), true);

/** Writes a text into a field, unless the user is typing there. */
export function write(field: HTMLInputElement, text: string): void {
    if (field !== typed) field.value = text;
}
