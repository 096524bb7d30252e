// SPDX-License-Identifier: Apache-2.0
// Every threshold below which a quantity counts as degenerate. Nothing outside this file compares
// against a magic epsilon.

// GGX alpha: a lobe whose alpha is smaller along both axes is a mirror (delta). When only one axis
// is smaller, that axis is raised to this value. The lobe is 1 mrad wide there: nothing an image
// shows, and about the last width at which a float half vector still carries the density to 1e-3.
const float ALPHA_MIRROR = 1e-3f;

// Largest ratio of both alphas. The albedos of narrower facets are up to 0.2 off (anisotropicAlbedo.glsl).
const float ALPHA_RATIO_MAX = 50.0f;

// Relative ior: closer to 1 than this there is no interface (F = 0, light passes straight). F0
// is 2.5e-9 at the border.
const float IOR_MATCHED = 1e-4f;

// alpha * |eta - 1|: the width of a refracted lobe. Below it refraction is still sampled through
// the microfacets, but flagged as delta and not evaluated, because the half vector of two nearly
// opposite directions has no precision left.
const float REFRACTION_DELTA = 3e-4f;

// Relative ior is kept within [1 / IOR_MAX, IOR_MAX]; F0 is 0.96 at the border.
const float IOR_MAX = 100.0f;

// Of n and k of metals: a white one by MaterialX's artistic_ior has n = 398, and F0 0.99.
const float METAL_IOR_MAX = 1000.0f;

// Reflectance at normal incidence above which a Schlick lobe's ior, derived from it, stops growing
// (ior 63).
const float F0_MAX = 0.9391f;

// The same of the base under a film (ior 1999), which refracts nothing.
const float FILM_BASE_F0_MAX = 0.998f;

// A lobe is scaled by at most the inverse of this when an albedo in a denominator vanishes (total
// internal reflection, table noise).
const float ALBEDO_MIN = 1e-3f;

// Smallest z of a sampled facet normal before it is scaled by alpha; guards rounding only.
const float NORMAL_Z_MIN = 1e-7f;

// Light that single scattering loses on average, below which no second lobe can hold it exactly:
// albedos are known within 1e-4.
const float MULTI_LOSS_MIN = 1e-3f;

// Guards a division whose numerator vanishes together with the denominator.
const float TINY = 1e-20f;

// Input range of tints and colours: negative and NaN become 0, Inf becomes this.
const float COLOR_MAX = 65504.0f;

// The same of emission: the product of two still is a float.
const float EMISSION_MAX = 1e15f;

// Smallest roughness of a sheen lobe; its exponent is 100 there.
const float SHEEN_ROUGHNESS_MIN = 0.01f;

// Largest exponent of the cosine power lobes; they are 4 mrad wide there.
const float EXPONENT_MAX = 1e5f;

// Smallest product of both cosines in Ward's lobe, which divides by its root.
const float WARD_COS_MIN = 1e-6f;

// Thin films in nm: thinner ones are left out (they change a reflectance by 2e-3 at most), thicker
// ones have no colour left. Their ior has the range of solids.
const float FILM_THICKNESS_MIN = 0.1f;
const float FILM_THICKNESS_MAX = 1e5f;
const float FILM_IOR_MAX = 5.0f;

// Bounds of a hair fibre's longitudinal variance and azimuthal scale: 0.5 degrees, and as good as
// uniform. Rays that graze the fibre arrive at HAIR_H_MAX of its radius at most.
const float HAIR_VARIANCE_MIN = 1e-4f;
const float HAIR_VARIANCE_MAX = 30.0f;
const float HAIR_SCALE_MIN = 0.008f;
const float HAIR_SCALE_MAX = 10.0f;
const float HAIR_H_MAX = 0.9999f;

// Largest |anisotropy| of a phase function: its peak is 2e6 / (4 pi) there, and 1 - g still has
// four digits.
const float PHASE_ANISOTROPY_MAX = 0.999f;
