// Only its header is wanted.
int main() {
    return 0;
}
