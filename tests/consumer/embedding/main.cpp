// SPDX-License-Identifier: GPL-3.0-or-later
double contact_gap();

int main() { return contact_gap() == 3 ? 0 : 1; }
