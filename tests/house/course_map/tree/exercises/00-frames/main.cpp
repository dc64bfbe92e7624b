int main() {
  plot("frame", {});
  plot("secret", {});
}
