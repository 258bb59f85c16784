// expect: corner
int main() {}
