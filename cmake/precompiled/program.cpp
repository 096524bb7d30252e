// SPDX-License-Identifier: Apache-2.0
// Only its header is wanted.
int main() {
    return 0;
}
