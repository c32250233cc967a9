// Figures of the server, SVG without scripts, ids and links.

/** Puts a figure into an element; its width becomes that of the element where that is smaller. */
export function put(host: HTMLElement, svg: string, words: string): void {
    const whole = new DOMParser().parseFromString(svg, "image/svg+xml").documentElement;
    const figure = document.importNode(whole, true);
    figure.classList.add("figure");
    figure.setAttribute("aria-label", words);
    host.replaceChildren(figure);
}
