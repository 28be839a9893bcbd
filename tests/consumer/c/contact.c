/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A program in C89 that asks for the gap of two ellipsoids: rows of centre, semi-axes and
 * quaternion. */
#include <stdio.h>
#include <string.h>

#include <tangency.h>

int main(void) {
  const double a[10] = {0, 0, 0, 1, 2, 3, 1, 0, 0, 0};
  const double b[10] = {0, 0, 7, 3, 2, 1, 1, 0, 0, 0};
  double gap = 0;
  tangency_contact_columns answers;
  int code;
  memset(&answers, 0, sizeof answers);
  answers.size = sizeof answers;
  answers.gap = &gap;
  code = tangency_contacts_of_rows(a, sizeof a, b, sizeof b, 1, NULL, &answers, 1);
  printf("gap %g, version %s\n", gap, tangency_version());
  if (code != TANGENCY_OK) printf("%s\n", tangency_error_message());
  return code == TANGENCY_OK && gap == 3 ? 0 : 1;
}
