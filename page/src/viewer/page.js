/** The page that `infill.viewer.page` writes: a view of the data that are in it. */

import { decodeMesh } from "./mesh.js";
import { createViewer } from "./viewer.js";

const element = /** @type {HTMLElement} */ (document.getElementById("view"));
const viewer = createViewer(element, { label: document.title });
Object.assign(globalThis, { decodeMesh, viewer });
