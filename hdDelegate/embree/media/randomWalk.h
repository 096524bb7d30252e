// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/worldRays.h"
#include "hdDelegate/film/sampler.h"

namespace patina {

/// The medium beneath a surface whose thick slabs have a given albedo.
struct WalkMedium {
    vec3 extinction{0.0f}, scattering{0.0f};
    vec3 color{0.0f}; ///< share of the light that comes out again
    float anisotropy = 0.0f;
};

/// Inverts albedo and mean free path: the single scattering albedo is that of van de Hulst's
/// approximation for a half space under diffuse light with similarity for the anisotropy (Kulla and
/// Conty 2017, Revisiting Physically Based Shading at Imageworks; OpenPBR and MaterialX take the
/// same). White stays exactly white. Colours are held within 0..1.
/// @param shortest mean free path that can be told from none
WalkMedium walkMedium(const SubsurfaceEntry& entry, float shortest = 0.0f);

/// Where a walk beneath a surface ends.
struct WalkExit {
    bool found = false;   ///< false: it never came out, or
    bool open = false;    ///< left through a hole of the object: weight lacks the colour then
    Hit hit;              ///< of the surface from inside
    vec3 origin{0.0f};    ///< of the ray that hit
    vec3 direction{0.0f}; ///< of the ray that hit
    vec3 weight{1.0f};
};

/// A direction in which light goes on beneath a surface that it enters as through a diffuse one.
struct WalkStart {
    vec3 direction{0, 0, 1}; ///< about +z inwards, unit
    float weight = 1.0f;
};

/// A dark medium gives back the light that goes along close to the surface and leaves by the
/// next turn of it, unscattered. The cosine finds such directions seldom; the darker the colour,
/// the more samples look for them.
/// @param u direction; uPart which strategy; in [0, 1)
WalkStart startWalk(const WalkMedium& medium, const vec2& u, float uPart);

/// Walks from just beneath a surface until the walk leaves the same object (after Chiang, Kutz and
/// Burley 2016, Practical and Controllable Subsurface Scattering for Production Path Tracing).
///
/// The boundary refracts nothing. Other objects inside are ignored. Where parts of the object
/// overlap, the walk ends at the outermost surface.
///
/// The first steps choose between leaving and scattering by the light that either is likely to
/// bring. With physical chances most walks in a dark medium would end inside, and the weights of
/// the rest would lie between its colour and 1. These steps also turn directions to the surface
/// where light went in (after Krivanek and d'Eon 2014, A Zero-Variance-Based Sampling Scheme for
/// Monte Carlo Subsurface Scattering).
/// @param entry where light went in; the side that the path sees counts as outside
/// @param back the path saw the back side
/// @param outside unit, out of the object where light went in
/// @param origin on the surface, or beneath it for a curve or a point
/// @param rays is counted up
WalkExit walkBeneath(const WorldRays& scene, const WalkMedium& medium, const Hit& entry, bool back,
                     const vec3& outside, vec3 origin, vec3 direction, Sampler& sampler,
                     uint64_t& rays);

} // namespace patina
