// SPDX-License-Identifier: Apache-2.0
// The fields of a pass, row by row; shaders/gpuStruct.inc says what rows there are.
PATINA_MATRIX(worldToClip)
PATINA_MATRIX(clipToWorld)
PATINA_ROW(eye, float, nearShift, 0)         // of the camera; along its axis, from its near plane to that of worldToClip
PATINA_ROW(forward, float, farReach, 0)      // view direction; along it, from the camera's near plane to its far plane
PATINA_ROW(passOrigin, float, pixelSpread, 0) // place in the world that all positions are relative to; angle or width of a pixel
PATINA_NUMBERS(int, isPerspective, lightsTaken, bsdfSamples, passIndex, 0) // 0: orthographic; counts up
// What random numbers begin from; how many of many lights a pixel takes; highest level of domes; cells of the sky along a side (0 none).
PATINA_NUMBERS(int, passSeed, lightsChosen, domeLevel, skySide, 0)
// Texels of a dome's image (0: none); factor of all colours; passes that will have been taken; extent of the scene.
PATINA_NUMBERS(float, domeTexels, exposure, passesTaken, sceneExtent, 0)
// Of lights: end of those that samples of the BSDF find; first whose sample is taken; first of those of which each pixel takes
// one in sharedEvery, or with many lights lightsChosen. In most passes: lightsTaken, 0, lightsTaken, 1.
PATINA_NUMBERS(int, lightsFound, firstSampled, firstShared, sharedEvery, 0)
PATINA_ROWS(clipPlanes, 8) // of the camera: what is behind one is not seen
PATINA_NUMBERS(int, planes, filteredSamples, cellsZ, unusedA, 0) // that clip; samples of filtered domes; see below
// Of the cells with lists of lights: where they begin, how many there are along x, y and z.
PATINA_ROW(cellsLow, int, cellsX, 0)
PATINA_ROW(cellsPerUnit, int, cellsY, 0)
