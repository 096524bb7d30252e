// SPDX-License-Identifier: Apache-2.0
// Everything that is drawn: the shape with its material, and what stands behind it.
import * as THREE from "three";
import { makeMaterial, textKey } from "./materials.js";

export class PageScene {
    constructor(data, parts) {
        this.data = data;
        this.parts = parts;
        this.shared = {
            albedoTable: { value: parts.albedo }, environmentMap: { value: null },
            worldToEnvironment: { value: new THREE.Matrix3() }, environmentScale: { value: new THREE.Vector3() },
            ambient: { value: new THREE.Vector3() }, environmentInfo: { value: new THREE.Vector2(1, 0) },
            environmentSamples: { value: null }, environmentDensity: { value: new THREE.Vector3() },
            lightSamples: { value: new Int32Array(2) },
            lightData: { value: null }, lightTable: { value: parts.lightTable }, lightCount: { value: 0 }, eye: { value: new THREE.Vector3() },
            pixelAngle: { value: 0.001 }, passInfo: { value: new Int32Array(4) },
            jitter: { value: new THREE.Vector2() }, objectToWorld: { value: new THREE.Matrix4() },
            normalToWorld: { value: new THREE.Matrix3() }, worldToClip: { value: new THREE.Matrix4() },
            clipToWorld: { value: new THREE.Matrix4() }, plain: { value: new THREE.Vector4() }
        };
        this.programs = new Map();
        this.edited = new Map(); // texts that a user has changed and compiled
        this.mesh = new THREE.Mesh();
        this.backdrop = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), new THREE.RawShaderMaterial({
            glslVersion: THREE.GLSL3, uniforms: this.shared, depthTest: false, depthWrite: false,
            vertexShader: data.library.backdropVertex, fragmentShader: data.library.backdrop
        }));
        this.backdrop.frustumCulled = this.mesh.frustumCulled = false;
        this.backdrop.renderOrder = -1;
        this.scene = new THREE.Scene();
        this.scene.add(this.backdrop, this.mesh);
    }

    // The lean text while the sliders that it leaves out stand where they were, else the whole.
    programFor(index, program, needsAll) {
        const key = textKey(this.data.materials[index], index, program, needsAll);
        if (this.edited.has(key)) return this.edited.get(key);
        if (!this.programs.has(key)) this.programs.set(key, this.make(index, program, needsAll));
        return this.programs.get(key);
    }

    make(index, program, needsAll, parts) {
        return makeMaterial(this.data, index, program, needsAll, this.shared, this.parts.textures, parts);
    }

    setShape(shape) {
        this.mesh.geometry = shape.geometry;
        this.shape = shape;
        this.shared.objectToWorld.value.copy(shape.transform);
        this.shared.normalToWorld.value.getNormalMatrix(shape.transform);
    }

    setCamera(camera, height) {
        camera.updateMatrixWorld();
        const s = this.shared;
        s.eye.value.setFromMatrixPosition(camera.matrixWorld);
        s.worldToClip.value.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
        s.clipToWorld.value.copy(s.worldToClip.value).invert();
        s.pixelAngle.value = 2 * Math.tan(camera.fov * Math.PI / 360) / height;
    }
}
