// SPDX-License-Identifier: Apache-2.0
// Geometry of the page's shapes.
import * as THREE from "three";
import { unpack } from "./data.js";

export async function makeShape(shape) {
    const geometry = new THREE.BufferGeometry();
    for (const [name, a] of Object.entries(shape.attributes))
        geometry.setAttribute(name, new THREE.BufferAttribute(await unpack(a.data, "f4"), a.size));
    const points = geometry.getAttribute("position");
    geometry.setAttribute("objectPosition", points);
    if (!geometry.getAttribute("color"))
        geometry.setAttribute("color", new THREE.BufferAttribute(
            new Float32Array(points.count * 3).fill(0.18), 3));
    geometry.setIndex(new THREE.BufferAttribute(await unpack(shape.indices, "u4"), 1));
    const transform = new THREE.Matrix4().fromArray(shape.toWorld);
    return { name: shape.name, closed: shape.closed, geometry, transform };
}
