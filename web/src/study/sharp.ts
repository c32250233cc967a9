// Charts are drawn with three pixels for each one of the screen or more, so that they are sharp in print. uPlot reads the ratio when it is
// loaded: this module comes before it.

/** Pixels of the picture for one of the page: 288 per inch of paper. */
const LEAST = 3;

const ratio = Math.max(LEAST, devicePixelRatio);
Object.defineProperty(window, "devicePixelRatio", { get: () => ratio });
