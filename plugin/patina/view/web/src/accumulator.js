// SPDX-License-Identifier: Apache-2.0
// The mean over passes, and its display.
import * as THREE from "three";

const quadVertex = "in vec3 position; out vec2 at; void main() { at = 0.5 * position.xy + 0.5;" +
    " gl_Position = vec4(position.xy, 0.0, 1.0); }";
const meanText = `precision highp float; precision highp sampler2D;
uniform sampler2D mean; uniform sampler2D next; uniform float share; out vec4 color;
void main() { ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 n = texelFetch(next, p, 0);
    color = share >= 1.0 ? n : mix(texelFetch(mean, p, 0), n, share); }`;
const displayText = `precision highp float; precision highp sampler2D;
uniform sampler2D mean; uniform sampler2D reference; uniform float scale; uniform float wipe;
uniform vec2 size; in vec2 at; out vec4 color;
vec3 encode(vec3 c) { c = clamp(c, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)); }
void main() { vec3 c = texelFetch(mean, ivec2(gl_FragCoord.xy), 0).rgb;
    // The reference is square, and as wide or high as the picture's shorter side.
    vec2 q = (at - 0.5) * max(size / size.yx, 1.0) + 0.5;
    if (at.x > wipe && all(lessThanEqual(abs(q - 0.5), vec2(0.5)))) c = texture(reference, vec2(q.x, 1.0 - q.y)).rgb;
    if (wipe < 1.0 && abs(at.x - wipe) * size.x < 1.0) color = vec4(1.0);
    else color = vec4(encode(c * scale), 1.0); }`;

export class Accumulator {
    constructor(renderer) {
        this.renderer = renderer;
        const whole = renderer.extensions.has("EXT_color_buffer_float");
        this.type = whole ? THREE.FloatType : THREE.HalfFloatType;
        const target = depth => new THREE.WebGLRenderTarget(1, 1, {
            type: this.type, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter, depthBuffer: depth
        });
        this.pass = target(true);
        this.means = [target(false), target(false)];
        const material = (fragmentShader, uniforms) => new THREE.RawShaderMaterial({
            glslVersion: THREE.GLSL3, vertexShader: quadVertex, fragmentShader, uniforms,
            depthTest: false, depthWrite: false
        });
        this.mean = material(meanText, { mean: { value: null }, next: { value: null }, share: { value: 1 } });
        this.display = material(displayText, {
            mean: { value: null }, reference: { value: null }, scale: { value: 1 }, wipe: { value: 1 },
            size: { value: new THREE.Vector2() }
        });
        this.quad = new THREE.Mesh(new THREE.PlaneGeometry(2, 2));
        this.quad.frustumCulled = false;
        this.scene = new THREE.Scene().add(this.quad);
        this.camera = new THREE.Camera();
        this.count = 0;
    }

    resize(width, height) {
        for (const t of [this.pass, ...this.means]) t.setSize(width, height);
        this.display.uniforms.size.value.set(width, height);
        this.count = 0;
    }

    _draw(material, target) {
        this.quad.material = material;
        this.renderer.setRenderTarget(target);
        this.renderer.render(this.scene, this.camera);
    }

    // Adds what `draw` renders into its target.
    add(draw) {
        draw(this.pass);
        const [old, now] = this.means;
        Object.assign(this.mean.uniforms.mean, { value: old.texture });
        this.mean.uniforms.next.value = this.pass.texture;
        this.mean.uniforms.share.value = 1 / ++this.count;
        this._draw(this.mean, now);
        this.means.reverse();
    }

    show(scale, reference, wipe) {
        const u = this.display.uniforms;
        u.mean.value = this.means[0].texture;
        u.reference.value = reference ?? this.means[0].texture;
        u.scale.value = scale;
        u.wipe.value = reference ? wipe : 1;
        this._draw(this.display, null);
    }

    // Linear colour of the mean, bottom row first.
    read() {
        const { width, height } = this.means[0];
        const half = this.type === THREE.HalfFloatType;
        const out = new (half ? Uint16Array : Float32Array)(4 * width * height);
        this.renderer.readRenderTargetPixels(this.means[0], 0, 0, width, height, out);
        return half ? Float32Array.from(out, x => THREE.DataUtils.fromHalfFloat(x)) : out;
    }
}
