// SPDX-License-Identifier: Apache-2.0
// The fields of a triangle; shaders/gpuStruct.inc says what rows there are.
PATINA_ROW(dPdu, float, uvPerLength, 0) // object space; root of texture area per area
PATINA_ROW(dPdv, int, element, 0)       // the authored face
PATINA_ROW(normal, float, slope, 0)     // geometric, object space, not of unit length; of a curve's radius
