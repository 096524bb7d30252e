// SPDX-License-Identifier: Apache-2.0
#include <openvdb/openvdb.h>

int main() {
    openvdb::initialize();
}
