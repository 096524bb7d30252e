// SPDX-License-Identifier: Apache-2.0
// The fields of a cell of the sky; shaders/gpuStruct.inc says what rows there are.
PATINA_MATRIX(worldToMap)
PATINA_MATRIX(worldToFibres)
PATINA_ROW(towards, int, layer, -1)                           // the direction drawn; of the map, -1: none yet
PATINA_NUMBERS(int, fibreLayer, unusedA, unusedB, unusedC, -1) // of the fibres' map, -1: none
