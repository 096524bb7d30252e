// SPDX-License-Identifier: Apache-2.0
// The fields of an instance, as attributes of the vertex stage; shaders/gpuStruct.inc says what rows there are.
PATINA_ATTRIBUTE(2, vec4, column0) // object to world, in columns; w: cube root of the determinant
PATINA_ATTRIBUTE(3, vec4, column1)
PATINA_ATTRIBUTE(4, vec4, column2)
PATINA_ATTRIBUTE(5, vec4, column3)
PATINA_ATTRIBUTE(6, vec4, normalColumn0) // the same for normals
PATINA_ATTRIBUTE(7, vec4, normalColumn1)
PATINA_ATTRIBUTE(8, vec4, normalColumn2)
PATINA_ATTRIBUTE(9, ivec4, instanceIds) // instance, row of links, number in its group, place of its prim
