#include <openvdb/openvdb.h>

int main() {
    openvdb::initialize();
}
