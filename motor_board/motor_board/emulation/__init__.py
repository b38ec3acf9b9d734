"""The emulated board: a built firmware and a motor's parameters in; bytes out, as the real board would send them."""
