// SPDX-License-Identifier: Apache-2.0
// The page by keys: everything in the panel has the tab key, the picture has these.
import * as THREE from "three";
import { savePicture } from "./actions.js";

function turn(page, across, up) {
    const { camera } = page.viewer, { target } = page.controls;
    const arm = camera.position.clone().sub(target);
    const right = new THREE.Vector3(1, 0, 0).applyQuaternion(camera.quaternion);
    const spin = new THREE.Quaternion().setFromAxisAngle(camera.up.clone().normalize(), across)
        .multiply(new THREE.Quaternion().setFromAxisAngle(right, up));
    arm.applyQuaternion(spin);
    camera.up.applyQuaternion(new THREE.Quaternion().setFromAxisAngle(right, up));
    camera.position.copy(target).add(arm);
    camera.lookAt(target);
    page.viewer.invalidate();
}

function nearer(page, factor) {
    const { camera } = page.viewer, { target } = page.controls;
    const arm = camera.position.clone().sub(target);
    const minimum = page.data.camera.radius * 1.2;
    camera.position.copy(target).add(arm.setLength(Math.max(minimum, arm.length() * factor)));
    page.viewer.invalidate();
}

export function listen(page) {
    const step = 0.15;
    const keys = {
        ArrowLeft: () => turn(page, -step, 0), ArrowRight: () => turn(page, step, 0),
        ArrowUp: () => turn(page, 0, -step), ArrowDown: () => turn(page, 0, step),
        "+": () => nearer(page, 0.9), "-": () => nearer(page, 1 / 0.9),
        n: () => page.choose((page.state.material + 1) % page.data.materials.length),
        b: () => page.choose((page.state.material + page.data.materials.length - 1) % page.data.materials.length),
        s: () => { page.state.shape = (page.state.shape + 1) % page.data.shapes.length; page.refresh(); },
        e: () => { page.state.environment = (page.state.environment + 1) % page.data.environments.length;
                   page.refresh(); },
        "[": () => { page.state.exposure -= 0.5; page.refresh(); },
        "]": () => { page.state.exposure += 0.5; page.refresh(); },
        c: () => page.drawer.toggle(page.code), l: () => page.drawer.toggle(page.plan),
        p: () => savePicture(page), r: () => page.reset(),
        "?": () => page.say("Keys: arrows turn, + and - come nearer and go, n and b next material and back, " +
            "s shape, e environment, [ and ] exposure, p picture, c shader, l plan, r reset.")
    };
    window.addEventListener("keydown", event => {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        if (event.target.closest?.("input, select, button, textarea, #panel, #drawer")) return;
        if (!(event.key in keys)) return;
        event.preventDefault();
        keys[event.key]();
    });
}
