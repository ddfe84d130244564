% The wheelset of hunting.c, in Octave, over the pipe of wheelset_pipe.c.
% usage: octave hunting.m WHEELSET_PIPE CASE SPEED SPRINGS STEP LENGTH
1;

function [out, difference] = rates(pipe, speed, springs, x, q)
  mass = 1500; inertia = 1000; stiffness_y = 2e6; stiffness_yaw = 2e6; load = 160e3;
  aside = 0.25e-3 * (1 - cos(pi * min(x, 2) / 2));
  fprintf(pipe.in, "%.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", q, speed, load, aside);
  fflush(pipe.in);
  line = -1;
  while (! ischar(line))
    fclear(pipe.out);
    line = fgetl(pipe.out);
    if (! ischar(line))
      pause(1e-4);
      [pid, status] = waitpid(pipe.pid, WNOHANG);
      if (pid == pipe.pid)
        error("wheelset_pipe has ended");
      end
    end
  end
  answer = sscanf(line, "%f");
  out = [q(3); q(4); (answer(1) - springs * stiffness_y * q(1)) / mass; ...
         (answer(2) - springs * stiffness_yaw * q(2)) / inertia];
  difference = answer(3) - answer(4);
end

words = argv();
numbers = cellfun(@str2double, words(3:6));
speed = numbers(1); springs = numbers(2); step = numbers(3); length_m = numbers(4);
[pipe.in, pipe.out, pipe.pid] = popen2(words{1}, words(2));
small = [1e-4 1e-4 1e-3 1e-3];
jacobian = zeros(4);
for j = 1:4
  moved = zeros(4, 1);
  moved(j) = small(j);
  more = rates(pipe, speed, springs, 0, moved);
  jacobian(:, j) = (more - rates(pipe, speed, springs, 0, -moved)) / (2 * small(j));
end
gamma_ros = 1 - sqrt(0.5);
h = step / speed;
matrix = eye(4) - gamma_ros * h * jacobian;
x = 0;
q = zeros(4, 1);
printf("x_m,y_mm,yaw_mrad,radius_difference_mm\n");
while (x < length_m)
  [one, difference] = rates(pipe, speed, springs, x, q);
  printf("%.4f,%.7f,%.7f,%.7f\n", x, 1e3 * q(1), 1e3 * q(2), 1e3 * difference);
  one = matrix \ one;
  two = matrix \ (rates(pipe, speed, springs, x + step, q + h * one) - 2 * one);
  q += h * (1.5 * one + 0.5 * two);
  x += step;
end
fclose(pipe.in);
fclose(pipe.out);
waitpid(pipe.pid);
