// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/shaders.h"

// The directional albedo of the Conty-Kulla sheen lobe before it is bounded, as a polynomial in the
// root of the cosine and the logarithm of the roughness.
// Written by shaders/bake/sheenFit.py. Over 40 x 40 cell centres: RMSE 6.3e-04, largest
// error 3.4e-03. Only measured: the renderer has the table.

// mu in [0, 1], roughness in [SHEEN_ROUGHNESS_MIN, 1].
inline float sheenAlbedoFit(float mu, float roughness) {
    using namespace patina::sh;
    float x = sqrt(mu);
    float y = log2(roughness);
    float c0 = (((0.00052008755f * y + 0.0090404944f) * y + 0.065809131f) * y - 0.20965652f) * y -
               0.61849958f;
    float c1 = (((-0.0078891292f * y - 0.090208501f) * y - 0.19857368f) * y + 0.51091826f) * y -
               0.81637245f;
    float c2 =
        (((0.050212134f * y + 0.65321636f) * y + 1.4224365f) * y - 1.8645966f) * y - 1.4998918f;
    float c3 =
        (((-0.14545996f * y - 1.9872049f) * y - 5.5540113f) * y + 4.2374163f) * y - 0.12290245f;
    float c4 = (((0.15176181f * y + 2.4293735f) * y + 7.803968f) * y - 3.7536798f) * y + 2.0058653f;
    float c5 =
        (((-0.052172855f * y - 0.99944365f) * y - 3.7486453f) * y + 1.5933877f) * y - 1.7677076f;
    return exp2(min(((((c5 * x + c4) * x + c3) * x + c2) * x + c1) * x + c0, 4.0f));
}
