// SPDX-License-Identifier: Apache-2.0
// libpatina.so is made of the rooms' own libraries; a target wants one file.
