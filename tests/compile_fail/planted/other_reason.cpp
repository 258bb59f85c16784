// expect: corner
int main() {
#ifdef MISUSE
    return missing;
#endif
}
